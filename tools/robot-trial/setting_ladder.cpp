#include "tools/robot-trial/setting_ladder.h"

#include <algorithm>
#include <vector>

namespace nao {
namespace {

struct Rung {
  double RobotSettings::*setting;
  std::vector<double> values;
};

// In the order in which they cured published robots: servos that sag, a walk that is too fast, feet
// that drag, knees that are too weak or too straight, a step that the joints cannot follow.
const std::vector<Rung>& rungs() {
  static const std::vector<Rung> list = {{&RobotSettings::peak_error, {0.07, 0.05}},
                                         {&RobotSettings::speed, {0.7, 0.5}},
                                         {&RobotSettings::swing_height, {1.5, 0.6}},
                                         {&RobotSettings::hip_height, {1.03, 0.96}},
                                         {&RobotSettings::step_duration, {1.25, 0.8}}};
  return list;
}

}  // namespace

RobotSettings climb_ladder(const std::function<SettingsResult(const RobotSettings&)>& evaluate,
                           const std::function<bool()>& is_time_over, SettingsResult& result) {
  RobotSettings best;
  result = evaluate(best);
  std::vector<RobotSettings> known = {best};
  for (bool is_better = true; is_better;) {
    is_better = false;
    for (const Rung& rung : rungs()) {
      for (const double value : rung.values) {
        if (result.holds() || is_time_over()) return best;
        // The gait does not matter to a robot that does not stand.
        if (result.stands == 0 && rung.setting != &RobotSettings::peak_error) continue;
        RobotSettings settings = best;
        settings.*rung.setting = value;
        if (std::find(known.begin(), known.end(), settings) != known.end()) continue;
        known.push_back(settings);
        const SettingsResult found = evaluate(settings);
        if (found.score() <= result.score()) continue;
        best = settings;
        result = found;
        is_better = true;
      }
    }
  }
  return best;
}

}  // namespace nao
