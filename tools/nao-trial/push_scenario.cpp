#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "kinematics/pose2.h"
#include "tools/nao-trial/fall_warning.h"
#include "tools/nao-trial/scenarios.h"
#include "tools/nao-trial/statistics.h"

namespace nao::trial {
namespace {

// Impulses are N s for each kg of the robot, so that robots of any size compare: such a push
// changes the velocity of the center of mass by as many m/s.
constexpr double kGreatest = 2.0;
constexpr int kNumHalvings = 7;  // bisection: to 2.0 / 2^7 = 0.016
/** Asked in every direction. Source: published humanoids withstand 0.2 to 0.3 standing and walking
 * by a model, 1.1 by a learned policy. */
constexpr double kAskedOfMass = 0.2;
constexpr int kNumDirections = 8;
constexpr int kNumPlotDirections = 24;
/** A walking robot is pushed at so many times, s apart: two steps of a NAO, one of a large robot.
 */
constexpr int kNumTimes = 6;
constexpr double kBetweenTimes = 0.1;
constexpr double kBefore = 0.5;  // s before the push, or the walk
constexpr double kWalk = 3;      // s before the first of the times
constexpr double kWatch = 4;     // s after the push
// Pushes in a row: their number, and the times between two of them, s. Chosen: from before the
// robot has come to rest until well after it stands again.
constexpr int kNumPushes = 10;
constexpr double kLeastPause = 1;
constexpr double kGreatestPause = 5;

/** Bisection. @return The greatest impulse withstood, N s/kg. */
double find_greatest(const std::function<bool(double impulse)>& withstands) {
  double withstood = 0;
  double lost = kGreatest;
  for (int i = 0; i < kNumHalvings; ++i) {
    const double impulse = (withstood + lost) / 2;
    (withstands(impulse) ? withstood : lost) = impulse;
  }
  return withstood;
}

/** @param direction  rad, to the left of straight ahead. @param impulse  N s/kg. */
void push(ClosedLoop& trial, double direction, double impulse) {
  const double heading = Pose2::from(trial.torso_in_world()).heading + direction;
  const double size = impulse * trial.model().total_mass();
  trial.world().push(0, 0, {size * std::cos(heading), size * std::sin(heading), 0});
}

bool is_standing(const ClosedLoop& trial) {
  return trial.torso_tilt() < 0.3 &&
         trial.torso_height() > 0.875 * trial.model().references().heights.standing;
}

class PushCourse {
 public:
  PushCourse(const ScenarioOptions& options, uint64_t seed) : options_(options), seed_(seed) {
    // The robot must not get up, so that a fall remains one.
    options_.trial.motion.gets_up = false;
  }

  /** Greatest impulse withstood at every time, N s/kg. @param direction  rad, from straight ahead.
   * @param result  Takes the times of warning of the falls. */
  double find_boundary(double direction, RunResult& result) const {
    return find_greatest([&](double impulse) { return withstands(direction, impulse, result); });
  }

 private:
  bool withstands(double direction, double impulse, RunResult& result) const {
    const int num_times = options_.velocity.isZero(0) ? 1 : kNumTimes;
    for (int i = 0; i < num_times; ++i) {
      if (!withstands(direction, impulse, i * kBetweenTimes, result)) return false;
    }
    return true;
  }

  bool withstands(double direction, double impulse, double time, RunResult& result) const {
    ClosedLoop trial(options_.trial, seed_);
    trial.run(kBefore);
    if (!options_.velocity.isZero(0)) {
      trial.hold_walk(options_.velocity);
      trial.run(kWalk + time);
    }
    push(trial, direction, impulse);
    FallWarning fall;
    trial.on_tick([&] { fall.look(trial); });
    trial.run(kWatch);
    if (fall.warning()) result.metrics.emplace_back("warning_ms", *fall.warning() * 1e3);
    return !fall.has_touched() && is_standing(trial);
  }

  ScenarioOptions options_;
  uint64_t seed_;
};

/** Whether a robot that stands withstands pushes of one size from anywhere, in a row. */
bool withstands_pushes(const ScenarioOptions& options, uint64_t seed, double impulse) {
  ClosedLoop trial(options.trial, seed);
  trial.run(kBefore);
  for (int i = 0; i < kNumPushes; ++i) {
    push(trial, trial.random(-M_PI, M_PI), impulse);
    trial.run(trial.random(kLeastPause, kGreatestPause));
    if (!is_standing(trial)) return false;
  }
  trial.run(kWatch);
  return is_standing(trial);
}

/** @param withstood  N s/kg. */
void judge(double withstood, RunResult& result) {
  result.metrics.emplace_back("withstood_Ns_per_kg", withstood);
  result.is_success = withstood >= kAskedOfMass;
  if (!result.is_success) result.failure = "fell below the required impulse";
}

std::vector<RunResult> run_pushes(ScenarioOptions options, uint64_t seed) {
  options.trial.motion.gets_up = false;
  RunResult result;
  judge(find_greatest([&](double impulse) { return withstands_pushes(options, seed, impulse); }),
        result);
  return {result};
}

std::string boundary_name(int direction, int num_directions) {
  return fmt::format("withstood_{:03}_Ns_per_kg", direction * 360 / num_directions);
}

constexpr double kPlotScale = 450;   // pixels per N s/kg
constexpr double kPlotCenter = 340;  // pixels

/** Forward is up, left is left. */
std::string polygon(const std::vector<double>& impulses, const std::string& style) {
  std::string points;
  for (size_t i = 0; i < impulses.size(); ++i) {
    const double direction = 2 * M_PI * static_cast<double>(i) / kNumPlotDirections;
    points +=
        fmt::format("{:.1f},{:.1f} ", kPlotCenter - kPlotScale * impulses[i] * std::sin(direction),
                    kPlotCenter - kPlotScale * impulses[i] * std::cos(direction));
  }
  return fmt::format("<polygon points=\"{}\" {}/>\n", points, style);
}

std::string text(double x, double y, const std::string& words) {
  return fmt::format("<text x=\"{}\" y=\"{}\">{}</text>\n", x, y, words);
}

std::map<std::string, std::string> push_course_units() {
  std::map<std::string, std::string> units{{"withstood_Ns_per_kg", "N s/kg"}, {"warning_ms", "ms"}};
  for (const int count : {kNumDirections, kNumPlotDirections}) {
    for (int i = 0; i < count; ++i) units[boundary_name(i, count)] = "N s/kg";
  }
  return units;
}

std::vector<RunResult> run_push_course(const ScenarioOptions& options, uint64_t seed) {
  const PushCourse course(options, seed);
  const int num_directions = options.is_for_plot ? kNumPlotDirections : kNumDirections;
  RunResult result;
  double least = kGreatest;
  for (int i = 0; i < num_directions; ++i) {
    const double withstood = course.find_boundary(2 * M_PI * i / num_directions, result);
    result.metrics.emplace_back(boundary_name(i, num_directions), withstood);
    least = std::min(least, withstood);
  }
  judge(least, result);
  return {result};
}

/** Greatest impulse withstood in every direction: median and minimum of the seeds. */
std::string plot_push_course(const Summary& summary) {
  std::map<std::string, std::vector<double>> values;
  for (const RunResult& run : summary.runs) {
    for (const auto& [name, value] : run.metrics) values[name].push_back(value);
  }
  std::vector<double> medians;
  std::vector<double> leasts;
  for (int i = 0; i < kNumPlotDirections; ++i) {
    const MetricStatistics impulse = calc_statistics(boundary_name(i, kNumPlotDirections),
                                                     values[boundary_name(i, kNumPlotDirections)]);
    medians.push_back(impulse.median);
    leasts.push_back(impulse.worst);
  }
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{0}\" "
      "font-family=\"sans-serif\" font-size=\"14\">\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
      2 * kPlotCenter);
  for (const double impulse : {0.2, 0.4, 0.6}) {
    svg += fmt::format("<circle cx=\"{0}\" cy=\"{0}\" r=\"{1}\" fill=\"none\" stroke=\"#bbb\"/>\n",
                       kPlotCenter, impulse * kPlotScale);
    svg += text(kPlotCenter + 4, kPlotCenter - impulse * kPlotScale - 4,
                fmt::format("{} N s/kg", impulse));
  }
  svg += polygon(medians, "fill=\"#36c\" fill-opacity=\"0.2\" stroke=\"#36c\" stroke-width=\"2\"");
  svg += polygon(leasts, "fill=\"none\" stroke=\"#d33\" stroke-width=\"2\"");
  svg += text(10, 20, "Greatest impulse withstood, for each kg of the robot");
  svg += text(10, 40, fmt::format("blue: median, red: minimum of {} seeds", summary.runs.size()));
  svg += text(kPlotCenter - 25, 2 * kPlotCenter - 10, "backward");
  svg += text(10, kPlotCenter, "left");
  return svg + "</svg>\n";
}

}  // namespace

Scenario push_course_scenario() {
  return {"push-course",
          "Withstand pushes at the torso in eight directions, standing or at --vx --vy --wz",
          push_course_units(),
          run_push_course,
          "empty",
          plot_push_course};
}

Scenario pushes_scenario() {
  return {"pushes",
          "Withstand ten pushes at the torso in a row, from random directions",
          {{"withstood_Ns_per_kg", "N s/kg"}},
          run_pushes};
}

}  // namespace nao::trial
