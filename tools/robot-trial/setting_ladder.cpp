#include "tools/robot-trial/setting_ladder.h"

#include <algorithm>
#include <random>
#include <vector>

namespace nao {
namespace {

using Setting = double RobotSettings::*;
struct Rung {
  Setting setting;
  std::vector<double> values;
};

// In the order in which they cured published robots: servos that sag, a walk that is too fast, feet
// that drag, knees that are too weak or too straight, a step that the joints cannot follow, hips so
// far apart that narrow soles do not hold the balance to the side.
const std::vector<Rung>& rungs() {
  static const std::vector<Rung> list = {
      {&RobotSettings::peak_error, {0.07, 0.05}},   {&RobotSettings::speed, {0.7, 0.5}},
      {&RobotSettings::swing_height, {1.5, 0.6}},   {&RobotSettings::hip_height, {1.03, 0.96}},
      {&RobotSettings::step_duration, {1.25, 0.8}}, {&RobotSettings::foot_distance, {0.85, 0.75}}};
  return list;
}

// Settings that are drawn at random at most, and the seed.
constexpr int kMaxDraws = 200;
constexpr unsigned kSeed = 20140614;

class Climb {
 public:
  Climb(const std::function<SettingsResult(const RobotSettings&)>& evaluate,
        const std::function<bool()>& is_time_over, SettingsResult& result)
      : evaluate_(evaluate), is_time_over_(is_time_over), result_(result) {
    result_ = evaluate_(best_);
  }

  RobotSettings run() {
    climb();
    // Two or three settings may help only together.
    std::mt19937 random(kSeed);
    const auto below = [&](size_t count) { return random() % count; };
    for (int draw = 0; draw < kMaxDraws && !is_over(); ++draw) {
      RobotSettings settings = best_;
      for (size_t change = 0; change < 2 + below(2); ++change) {
        const Rung& rung = rungs()[below(rungs().size())];
        const size_t value = below(rung.values.size() + 1);
        settings.*rung.setting =
            value == 0 ? RobotSettings().*rung.setting : rung.values[value - 1];
      }
      if (try_settings(settings)) climb();
    }
    return best_;
  }

 private:
  bool is_over() const { return result_.holds() || is_time_over_(); }

  void climb() {
    for (bool is_better = true; is_better;) {
      is_better = false;
      for (const Rung& rung : rungs()) {
        for (const double value : rung.values) {
          if (is_over()) return;
          RobotSettings settings = best_;
          settings.*rung.setting = value;
          is_better |= try_settings(settings);
        }
      }
    }
  }

  /** @return Whether they are better than the best ones. */
  bool try_settings(const RobotSettings& settings) {
    // The gait does not matter to a robot that does not stand.
    RobotSettings gait = settings;
    gait.peak_error = best_.peak_error;
    if (result_.stands == 0 && gait != best_) return false;
    if (std::find(known_.begin(), known_.end(), settings) != known_.end()) return false;
    known_.push_back(settings);
    const SettingsResult found = evaluate_(settings);
    if (found.score() <= result_.score()) return false;
    best_ = settings;
    result_ = found;
    return true;
  }

  const std::function<SettingsResult(const RobotSettings&)>& evaluate_;
  const std::function<bool()>& is_time_over_;
  SettingsResult& result_;
  RobotSettings best_;
  std::vector<RobotSettings> known_ = {best_};
};

}  // namespace

RobotSettings climb_ladder(const std::function<SettingsResult(const RobotSettings&)>& evaluate,
                           const std::function<bool()>& is_time_over, SettingsResult& result) {
  return Climb(evaluate, is_time_over, result).run();
}

}  // namespace nao
