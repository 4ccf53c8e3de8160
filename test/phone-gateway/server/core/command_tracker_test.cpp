#include "phone-gateway/server/core/command_tracker.h"

#include <gtest/gtest.h>

namespace nao::gateway {
namespace {

Command posture(int64_t id) {
  return {"phone", id, PostureCommand{"Crouch", 0.5}};
}

Command joint_change(int64_t id) {
  return {"phone", id,
          JointChangeCommand{.joint_names = {"HeadYaw"},
                             .joint_position = {0.1},
                             .is_relative = true,
                             .speed = 0.3,
                             .allow_tipping = false}};
}

TEST(CommandTracker, RepeatsUntilAnswered) {
  CommandTracker tracker{GatewayLimits{}};
  tracker.add(1, 1, posture(5), 0);
  EXPECT_TRUE(tracker.take_due(0.05).empty());
  EXPECT_EQ(tracker.take_due(0.11).size(), 1u);
  EXPECT_EQ(tracker.take_due(0.22).size(), 1u);
  EXPECT_TRUE(tracker.handle_result("phone", 5, ResultStatus::kAccepted, 0.15).has_value());
  EXPECT_TRUE(tracker.take_due(0.5).empty());
  EXPECT_TRUE(tracker.take_timed_out(10).empty());
}

TEST(CommandTracker, ReportsEachResultOnce) {
  CommandTracker tracker{GatewayLimits{}};
  tracker.add(1, 7, posture(5), 0);
  EXPECT_EQ(tracker.handle_result("phone", 5, ResultStatus::kAccepted, 0.15)->request_id, 7u);
  EXPECT_FALSE(tracker.handle_result("phone", 5, ResultStatus::kAccepted, 0.15).has_value());
  EXPECT_EQ(tracker.handle_result("phone", 5, ResultStatus::kDone, 0.15)->client, 1u);
  EXPECT_FALSE(tracker.handle_result("phone", 5, ResultStatus::kDone, 0.15).has_value());
}

TEST(CommandTracker, IgnoresResultsOfOtherSenders) {
  CommandTracker tracker{GatewayLimits{}};
  tracker.add(1, 7, posture(5), 0);
  EXPECT_FALSE(tracker.handle_result("nao.1", 5, ResultStatus::kDone, 0.15).has_value());
  EXPECT_FALSE(tracker.handle_result("phone", 6, ResultStatus::kDone, 0.15).has_value());
}

TEST(CommandTracker, TimesOutUnansweredCommands) {
  CommandTracker tracker{GatewayLimits{}};
  tracker.add(1, 7, posture(5), 0);
  EXPECT_TRUE(tracker.take_timed_out(1.4).empty());
  EXPECT_EQ(tracker.take_timed_out(1.6).size(), 1u);
  EXPECT_EQ(tracker.size(), 0u);
}

TEST(CommandTracker, LetsANewerCommandReplaceAnUnansweredOne) {
  CommandTracker tracker{GatewayLimits{}};
  tracker.add(1, 7, posture(5), 0);
  EXPECT_EQ(tracker.supersede(CommandKind::kStop).size(), 1u);
  tracker.add(1, 8, joint_change(6), 0);
  EXPECT_TRUE(tracker.supersede(CommandKind::kJointChange).empty()) << "joint changes add up";
  EXPECT_EQ(tracker.supersede(CommandKind::kWalk).size(), 1u);
}

TEST(CommandTracker, KeepsAnAcceptedCommandWhenANewerOneComes) {
  CommandTracker tracker{GatewayLimits{}};
  tracker.add(1, 7, posture(5), 0);
  (void)tracker.handle_result("phone", 5, ResultStatus::kAccepted, 0.15);
  EXPECT_TRUE(tracker.supersede(CommandKind::kStop).empty());
  EXPECT_EQ(tracker.handle_result("phone", 5, ResultStatus::kInterrupted, 0.15)->request_id, 7u);
}

TEST(CommandTracker, DropsTheOldestOfMoreThan256Commands) {
  CommandTracker tracker{GatewayLimits{}};
  for (int64_t i = 1; i <= 1000; ++i) tracker.add(1, 1, posture(i), 0);
  EXPECT_EQ(tracker.size(), 256u);
}

TEST(CommandTracker, NeitherRepeatsWalksNorTimesThemOut) {
  CommandTracker tracker{GatewayLimits{}};
  tracker.add(1, 7, {"phone", 5, WalkCommand{0.1, 0, 0}}, 0);
  EXPECT_TRUE(tracker.take_due(10).empty());
  EXPECT_TRUE(tracker.take_timed_out(10).empty());
  EXPECT_TRUE(tracker.supersede(CommandKind::kStop).empty());
  EXPECT_EQ(tracker.handle_result("phone", 5, ResultStatus::kRefused, 10)->request_id, 7u);
}

}  // namespace
}  // namespace nao::gateway
