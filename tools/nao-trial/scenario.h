#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "closed_loop/closed_loop.h"

namespace nao::trial {

/** What one run of a scenario gave. */
struct RunResult {
  /** Which of a seed's several runs it is, such as "Sit to Stand"; empty if there is one. */
  std::string label;
  bool is_success = false;
  /** Why not, in a few words; empty on success. */
  std::string failure;
  /** Measured values; a name may have several from one run. */
  std::vector<std::pair<std::string, double>> metrics;
};

/** Options of the command line that scenarios look at. */
struct ScenarioOptions {
  ClosedLoopOptions trial;
  /** s; 0: as the scenario says. */
  double duration = 0;
  /** Wished for, where the scenario walks: m/s ahead and to the left, rad/s. */
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
  /** m; 0: as the scenario says. */
  double distance = 0;
  /** If not empty: true and estimated pose of the last seed's walk, ten times a second, as CSV. */
  std::string trace_file;
  /** Measure what plot() draws, in place of the usual. */
  bool is_for_plot = false;
};

struct Summary;

/** Something that the robot shall manage. One seed is one run, or several with labels. */
class Scenario {
 public:
  virtual ~Scenario() = default;
  virtual const char* name() const = 0;
  virtual const char* summary() const = 0;
  /** Unit of each metric, "s" or "m/s"; "1" for counts. */
  virtual std::map<std::string, std::string> units() const = 0;
  virtual std::vector<RunResult> run(const ScenarioOptions& options, uint64_t seed) const = 0;
  /** Picture of what runs with is_for_plot gave, as SVG; empty if there is none. */
  virtual std::string plot(const Summary& /*summary*/) const { return ""; }
  /** Scenes other than "empty" are named here. */
  virtual const char* scene() const { return "empty"; }
};

/** All scenarios, in the order in which --help lists them. */
const std::vector<std::unique_ptr<Scenario>>& scenarios();

}  // namespace nao::trial
