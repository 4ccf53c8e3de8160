#include "tools/robot-trial/setting_ladder.h"

#include <gtest/gtest.h>

namespace nao {
namespace {

bool never() {
  return false;
}

TEST(SettingLadder, EndsAtOnceWhenTheFirstSettingsHold) {
  int calls = 0;
  SettingsResult result;
  const auto best = climb_ladder(
      [&](const RobotSettings&) {
        ++calls;
        return SettingsResult{1, 1, 1};
      },
      never, result);
  EXPECT_EQ(best, RobotSettings());
  EXPECT_EQ(calls, 1);
  EXPECT_TRUE(result.holds());
}

TEST(SettingLadder, FindsSettingsThatHoldOnlyTogether) {
  // Stands with stiff servos only; then walks the better the slower and the higher it swings.
  SettingsResult result;
  const auto best = climb_ladder(
      [](const RobotSettings& settings) {
        SettingsResult found;
        found.stands = settings.peak_error < 0.06 ? 1 : 0;
        found.quality = found.stands *
                        ((settings.speed < 0.6 ? 0.5 : 0) + (settings.swing_height > 1 ? 0.5 : 0));
        found.walks = found.quality == 1 ? 1 : 0;
        return found;
      },
      never, result);
  EXPECT_EQ(best.peak_error, 0.05);
  EXPECT_EQ(best.speed, 0.5);
  EXPECT_EQ(best.swing_height, 1.5);
  EXPECT_TRUE(result.holds());
}

TEST(SettingLadder, GivesTheBestWhenNothingHoldsOrTheTimeIsOver) {
  int calls = 0;
  const auto evaluate = [&](const RobotSettings& settings) {
    ++calls;
    return SettingsResult{1, settings.peak_error == 0.07 ? 0.5 : 0, 0, "fell"};
  };
  SettingsResult result;
  EXPECT_EQ(climb_ladder(evaluate, never, result).peak_error, 0.07);
  EXPECT_EQ(result.failure, "fell");
  EXPECT_LT(calls, 300) << "no settings are tried twice";
  calls = 0;
  const auto is_late = [] { return true; };
  climb_ladder(evaluate, is_late, result);
  EXPECT_EQ(calls, 1);
}

}  // namespace
}  // namespace nao
