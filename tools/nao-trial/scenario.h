#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "sim/closed_loop/closed_loop.h"

namespace nao::trial {

/** Result of one run of a scenario. */
struct RunResult {
  /** Identifies one of several runs of a seed, such as "Sit to Stand"; empty if there is only one.
   */
  std::string label;
  bool is_success = false;
  /** Cause of the failure in a few words; empty on success. */
  std::string failure;
  /** Measured values; one run may give several values of one name. */
  std::vector<std::pair<std::string, double>> metrics;
};

/** Command-line options of scenarios. */
struct ScenarioOptions {
  ClosedLoopOptions trial;
  /** Duration of a run, s; 0: the scenario's default. */
  double duration = 0;
  /** Commanded velocity, where the scenario walks: m/s ahead, m/s to the left, rad/s. */
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
  /** Robots of each team of a match. */
  std::array<int, 2> team_sizes{2, 2};
  /** Distance, m; 0: the scenario's default. */
  double distance = 0;
  /** Calibrate each robot before its run, standing in so many directions; 0: not at all. */
  int num_calibration_directions = 0;
  /** If not empty: true and estimated pose of the last seed's walk, ten times a second, as CSV. */
  std::string trace_file;
  /** Measure what plot() draws instead of the default metrics. */
  bool is_for_plot = false;
};

struct Summary;

/** A task of the robot. */
struct Scenario {
  /** Also that of the subcommand. */
  std::string name;
  std::string summary;
  /** Unit of each metric, "s" or "m/s"; metrics without are counts. */
  std::map<std::string, std::string> units;
  /** One seed gives one run, or several with labels. */
  std::function<std::vector<RunResult>(const ScenarioOptions& options, uint64_t seed)> run;
  std::string scene = "empty";
  /** Draws runs with is_for_plot, as SVG; empty if the scenario has no plot. */
  std::function<std::string(const Summary& summary)> plot = {};
};

}  // namespace nao::trial
