#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tools/nao-trial/fall_warning.h"
#include "tools/nao-trial/scenarios.h"
#include "tools/nao-trial/statistics.h"

namespace nao::trial {
namespace {

constexpr double kLeast = 0.2;      // N s
constexpr double kGreatest = 4.0;   // N s
constexpr int kNumHalvings = 8;     // bisection: to (4.0 - 0.2) / 2^8 = 0.015 N s
constexpr int kNumDirections = 24;  // in the plot
constexpr double kWatch = 2.5;      // s after the push

struct Outcome {
  bool stands = false;
  /** Time from the motion core's fall prediction to the first contact of a link other than a foot,
   * s; nullopt if the robot stood, negative if the prediction came too late. */
  std::optional<double> warning;
};

Outcome push(const ScenarioOptions& options, uint64_t seed, double direction, double impulse) {
  ClosedLoopOptions trial_options = options.trial;
  // The robot must not get up, so that a fall remains one.
  trial_options.motion.gets_up = false;
  ClosedLoop trial(trial_options, seed);
  trial.run(0.5);
  trial.world().push(0, 0, {impulse * std::cos(direction), impulse * std::sin(direction), 0});
  FallWarning fall;
  trial.on_tick([&] { fall.look(trial); });
  trial.run(kWatch);
  Outcome outcome;
  outcome.stands = !fall.has_touched() && trial.torso_tilt() < 0.3 &&
                   trial.torso_height() > 0.875 * trial.model().references().heights.standing;
  outcome.warning = fall.warning();
  return outcome;
}

/** Bisection of the greatest impulse survived, to 0.015 N s. */
double find_boundary(const ScenarioOptions& options, uint64_t seed, double direction,
                     RunResult& result) {
  // Invariant: the robot survived `survived` (or it is the lower bound) and fell at `lost`.
  double survived = kLeast;
  double lost = kGreatest;
  for (int i = 0; i < kNumHalvings; ++i) {
    const double impulse = (survived + lost) / 2;
    const Outcome outcome = push(options, seed, direction, impulse);
    (outcome.stands ? survived : lost) = impulse;
    if (outcome.warning) result.metrics.emplace_back("warning_ms", *outcome.warning * 1e3);
  }
  return survived;
}

std::string boundary_name(int direction) {
  return fmt::format("boundary_{:03}_Ns", direction * 360 / kNumDirections);
}

std::vector<RunResult> measure_all_directions(const ScenarioOptions& options, uint64_t seed) {
  RunResult result;
  for (int i = 0; i < kNumDirections; ++i) {
    const double direction = 2 * M_PI * i / kNumDirections;
    result.metrics.emplace_back(boundary_name(i), find_boundary(options, seed, direction, result));
  }
  result.is_success = true;
  return {result};
}

constexpr double kPlotScale = 90;    // pixels per N s
constexpr double kPlotCenter = 340;  // pixels

/** Forward is up, left is left. */
std::string polygon(const std::vector<double>& impulses, const std::string& style) {
  std::string points;
  for (size_t i = 0; i < impulses.size(); ++i) {
    const double direction = 2 * M_PI * static_cast<double>(i) / kNumDirections;
    points +=
        fmt::format("{:.1f},{:.1f} ", kPlotCenter - kPlotScale * impulses[i] * std::sin(direction),
                    kPlotCenter - kPlotScale * impulses[i] * std::cos(direction));
  }
  return fmt::format("<polygon points=\"{}\" {}/>\n", points, style);
}

std::string text(double x, double y, const std::string& words) {
  return fmt::format("<text x=\"{}\" y=\"{}\">{}</text>\n", x, y, words);
}

}  // namespace

std::vector<RunResult> PushScenario::run(const ScenarioOptions& options, uint64_t seed) const {
  if (options.is_for_plot) return measure_all_directions(options, seed);
  // Directions of the impulse, rad, and the required impulse, N s.
  const struct {
    const char* name;
    double direction;
    double least;
  } cases[] = {{"forward", 0, 1.2},
               {"backward", M_PI, 0.9},
               {"left", M_PI / 2, 1.2},
               {"right", -M_PI / 2, 1.2}};
  std::vector<RunResult> results;
  for (const auto& one : cases) {
    RunResult result;
    result.label = one.name;
    const double survived = find_boundary(options, seed, one.direction, result);
    result.metrics.emplace_back(std::string(one.name) + "_impulse_Ns", survived);
    result.metrics.emplace_back("impulse_Ns", survived);
    result.is_success = survived >= one.least;
    if (!result.is_success) result.failure = "fell below the required impulse";
    results.push_back(std::move(result));
  }
  return results;
}

std::string PushScenario::plot(const Summary& summary) const {
  std::map<std::string, std::vector<double>> values;
  for (const RunResult& run : summary.runs) {
    for (const auto& [name, value] : run.metrics) values[name].push_back(value);
  }
  std::vector<double> medians;
  std::vector<double> leasts;
  for (int i = 0; i < kNumDirections; ++i) {
    const MetricStatistics impulse = calc_statistics(boundary_name(i), values[boundary_name(i)]);
    medians.push_back(impulse.median);
    leasts.push_back(impulse.worst);
  }
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{0}\" "
      "font-family=\"sans-serif\" font-size=\"14\">\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
      2 * kPlotCenter);
  for (int impulse = 1; impulse <= 3; ++impulse) {
    svg += fmt::format("<circle cx=\"{0}\" cy=\"{0}\" r=\"{1}\" fill=\"none\" stroke=\"#bbb\"/>\n",
                       kPlotCenter, impulse * kPlotScale);
    svg += text(kPlotCenter + 4, kPlotCenter - impulse * kPlotScale - 4,
                fmt::format("{} N s", impulse));
  }
  svg += polygon(medians, "fill=\"#36c\" fill-opacity=\"0.2\" stroke=\"#36c\" stroke-width=\"2\"");
  svg += polygon(leasts, "fill=\"none\" stroke=\"#d33\" stroke-width=\"2\"");
  svg += text(10, 20, "Greatest impulse at the torso survived without a step");
  svg += text(10, 40, fmt::format("blue: median, red: minimum of {} seeds", summary.runs.size()));
  svg += text(kPlotCenter - 25, 2 * kPlotCenter - 10, "backward");
  svg += text(10, kPlotCenter, "left");
  return svg + "</svg>\n";
}

}  // namespace nao::trial
