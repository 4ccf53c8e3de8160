#include "tools/nao-trial/statistics.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "common/json_writer.h"

namespace nao::trial {
namespace {

/** Most seeds listed for one cause of failure, in a line of the table. */
constexpr size_t kMaxSeedsListed = 8;

// All values of each metric over the runs; a run may give a metric several times or not at all.
std::map<std::string, std::vector<double>> collect(const Summary& summary) {
  std::map<std::string, std::vector<double>> values;
  for (const RunResult& run : summary.runs) {
    for (const auto& [name, value] : run.metrics) values[name].push_back(value);
  }
  return values;
}

std::string unit_of(const Summary& summary, const std::string& name) {
  const auto found = summary.units.find(name);
  return found == summary.units.end() ? "1" : found->second;
}

}  // namespace

int Summary::num_successes() const {
  return static_cast<int>(
      std::count_if(runs.begin(), runs.end(), [](const RunResult& run) { return run.is_success; }));
}

MetricStatistics calc_statistics(const std::string& name, std::vector<double> values) {
  // Sorted from good to bad, so that a percentile means the same for all metrics: 95 % of the runs
  // were at least as good. For speeds, impulses, distances and warning times more is better; for
  // the others, such as errors, less.
  std::sort(values.begin(), values.end());
  const bool is_error = name.find("error") != std::string::npos;
  if (!is_error && (name.ends_with("_mps") || name.ends_with("_Ns_per_kg") ||
                    name.ends_with("_m") || name.starts_with("warning"))) {
    std::reverse(values.begin(), values.end());
  }
  const auto at_fraction = [&](double fraction) {
    // Nearest rank: always a value that a run really had.
    return values[static_cast<size_t>(
        std::lround(fraction * static_cast<double>(values.size() - 1)))];
  };
  const double mean =
      std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
  return {mean, at_fraction(0.5), at_fraction(0.95), values.back()};
}

std::string to_table(const Summary& summary) {
  const int num_runs = static_cast<int>(summary.runs.size());
  std::string table =
      fmt::format("{}: {} of {} succeeded ({:.1f} %)\n", summary.scenario, summary.num_successes(),
                  num_runs, num_runs > 0 ? 100.0 * summary.num_successes() / num_runs : 0.0);
  const auto values = collect(summary);
  if (!values.empty()) {
    table += fmt::format("  {:28} {:>10} {:>10} {:>10} {:>10}  {}\n", "", "mean", "median", "p95",
                         "worst", "unit");
  }
  for (const auto& [name, list] : values) {
    const MetricStatistics statistics = calc_statistics(name, list);
    table +=
        fmt::format("  {:28} {:>10.4g} {:>10.4g} {:>10.4g} {:>10.4g}  {}\n", name, statistics.mean,
                    statistics.median, statistics.p95, statistics.worst, unit_of(summary, name));
  }
  std::map<std::string, std::vector<uint64_t>> failures;
  for (size_t i = 0; i < summary.runs.size(); ++i) {
    const RunResult& run = summary.runs[i];
    if (run.is_success) continue;
    // Groups equal failures, with seeds to repeat them.
    failures[run.label + (run.label.empty() ? "" : ": ") + run.failure].push_back(summary.seeds[i]);
  }
  for (const auto& [failure, seeds] : failures) {
    table += fmt::format("  failed {}: {} (seeds", seeds.size(), failure);
    for (size_t i = 0; i < std::min(seeds.size(), kMaxSeedsListed); ++i) {
      table += fmt::format(" {}", seeds[i]);
    }
    table += seeds.size() > kMaxSeedsListed ? " ...)\n" : ")\n";
  }
  return table;
}

std::string to_json(const Summary& summary) {
  const auto num_runs = static_cast<int>(summary.runs.size());
  JsonWriter json;
  json.begin_object();
  json.add("scenario", summary.scenario);
  json.add("engine", summary.engine);
  json.add("disturbances", summary.disturbances);
  json.add("model", summary.model);
  json.add("runs", num_runs);
  json.add("successes", summary.num_successes());
  json.add("rate", num_runs > 0 ? static_cast<double>(summary.num_successes()) / num_runs : 0.0);
  json.begin_object("metrics");
  for (const auto& [name, values] : collect(summary)) {
    const MetricStatistics statistics = calc_statistics(name, values);
    json.begin_object(name);
    json.add("mean", statistics.mean);
    json.add("median", statistics.median);
    json.add("p95", statistics.p95);
    json.add("worst", statistics.worst);
    json.add("unit", unit_of(summary, name));
    json.end();
  }
  return json.take() + "\n";
}

}  // namespace nao::trial
