#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "tools/nao-trial/scenario.h"

namespace nao::trial {

/** All runs of a scenario. */
struct Summary {
  std::string scenario;
  /** Physics engine, disturbances and robot model of all runs. */
  std::string engine;
  std::string disturbances;
  std::string model;
  std::vector<RunResult> runs;
  /** Seed of each run. */
  std::vector<uint64_t> seeds;
  std::map<std::string, std::string> units;

  int num_successes() const;
};

/** Mean, median, 95th percentile and worst of values. "Worst" is the maximum; for quantities that
 * should be large (names that end in "_mps", "_Ns" or "_m" without "error", or begin with
 * "warning") it is the minimum, and p95 is the 5th percentile.
 */
struct MetricStatistics {
  double mean = 0;
  double median = 0;
  double p95 = 0;
  double worst = 0;
};
MetricStatistics calc_statistics(const std::string& name, std::vector<double> values);

/** Text table: successes, metrics, and each cause of failure with its seeds. */
std::string to_table(const Summary& summary);
/** One line of JSON: scenario, engine, disturbances, model, runs, successes, rate, metrics. */
std::string to_json(const Summary& summary);

}  // namespace nao::trial
