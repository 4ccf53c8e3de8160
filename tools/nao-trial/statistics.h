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
  std::vector<RunResult> runs;
  /** Seed of each run. */
  std::vector<uint64_t> seeds;
  std::map<std::string, std::string> units;

  int num_successes() const;
};

/** Mean, median, 95th percentile and worst of some values. "Worst" is the greatest, for names that
 * tell of something wished for (ending in "_mps", "_Ns" or "_m", or a warning) the least; p95
 * likewise.
 */
struct MetricStatistics {
  double mean = 0;
  double median = 0;
  double p95 = 0;
  double worst = 0;
};
MetricStatistics calc_statistics(const std::string& name, std::vector<double> values);

/** Table for a person: successes, metrics, and each reason of failure with its seeds. */
std::string to_table(const Summary& summary);
/** As the specification has it: scenario, runs, successes, rate, metrics. */
std::string to_json(const Summary& summary);

}  // namespace nao::trial
