#include "messages/play_command.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace nao {
namespace {

TEST(PlayCommand, SurvivesItsMessage) {
  PlayCommand command{Behavior::kKick, PlayRole::kStriker, {{1.5, -2}}};
  EXPECT_EQ(to_play_command(to_message(command)), command);
  command.target_in_odometry.reset();
  EXPECT_EQ(to_play_command(to_message(command)), command);
}

TEST(PlayCommand, IsCheckedInEveryField) {
  EXPECT_FALSE(check(PlayCommand{Behavior::kAuto, PlayRole::kKeeper, {{100, -100}}}));
  EXPECT_EQ(check(PlayCommand{static_cast<Behavior>(7)})->code, "behavior-unknown");
  EXPECT_EQ(check(PlayCommand{static_cast<Behavior>(-1)})->code, "behavior-unknown");
  EXPECT_EQ(check(PlayCommand{Behavior::kScore, static_cast<PlayRole>(4)})->code, "role-unknown");
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 101.0}) {
    EXPECT_EQ(check(PlayCommand{Behavior::kKick, PlayRole::kNone, {{0, bad}}})->code,
              "target-out-of-range");
  }
}

TEST(PlayCommand, HasANameForEveryValue) {
  for (size_t i = 0; i < kBehaviorNames.size(); ++i) {
    EXPECT_EQ(find_behavior(kBehaviorNames[i]), static_cast<Behavior>(i));
    EXPECT_EQ(to_string(static_cast<Behavior>(i)), kBehaviorNames[i]);
  }
  EXPECT_EQ(find_behavior("moon-walk"), std::nullopt);
  EXPECT_EQ(to_string(static_cast<PlayPhase>(99)), "unknown");
}

}  // namespace
}  // namespace nao
