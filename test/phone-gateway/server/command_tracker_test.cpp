#include "phone-gateway/server/command_tracker.h"

#include <gtest/gtest.h>

namespace nao {
namespace {

NumberedCommand posture(int64_t id) {
  return {"phone", id, PostureGoal{"Crouch", 0.5}};
}

NumberedCommand joint_change(int64_t id) {
  return {"phone", id, JointChange{{"HeadYaw"}, {0.1}, 0.3, false}};
}

TEST(CommandTracker, RepeatsUntilAnswered) {
  CommandTracker tracker{GatewayLimits{}};
  tracker.add(1, 1, posture(5), 0);
  EXPECT_TRUE(tracker.due(0.05).empty());
  EXPECT_EQ(tracker.due(0.11).size(), 1u);
  EXPECT_EQ(tracker.due(0.22).size(), 1u);
  EXPECT_TRUE(tracker.answer("phone", 5, CommandStatus::kAccepted).has_value());
  EXPECT_TRUE(tracker.due(0.5).empty());
  EXPECT_TRUE(tracker.take_unanswered(10).empty());
}

TEST(CommandTracker, TellsEachOutcomeOnce) {
  CommandTracker tracker{GatewayLimits{}};
  tracker.add(1, 7, posture(5), 0);
  EXPECT_EQ(tracker.answer("phone", 5, CommandStatus::kAccepted)->request_id, 7u);
  EXPECT_FALSE(tracker.answer("phone", 5, CommandStatus::kAccepted).has_value());
  EXPECT_EQ(tracker.answer("phone", 5, CommandStatus::kDone)->client, 1u);
  EXPECT_FALSE(tracker.answer("phone", 5, CommandStatus::kDone).has_value());
}

TEST(CommandTracker, KnowsNoResultsOfOthers) {
  CommandTracker tracker{GatewayLimits{}};
  tracker.add(1, 7, posture(5), 0);
  EXPECT_FALSE(tracker.answer("nao.1", 5, CommandStatus::kDone).has_value());
  EXPECT_FALSE(tracker.answer("phone", 6, CommandStatus::kDone).has_value());
}

TEST(CommandTracker, GivesUpWhatIsNotAnswered) {
  CommandTracker tracker{GatewayLimits{}};
  tracker.add(1, 7, posture(5), 0);
  EXPECT_TRUE(tracker.take_unanswered(1.4).empty());
  EXPECT_EQ(tracker.take_unanswered(1.6).size(), 1u);
  EXPECT_EQ(tracker.size(), 0u);
}

TEST(CommandTracker, LetsANewerCommandReplaceAnUnheardOne) {
  CommandTracker tracker{GatewayLimits{}};
  tracker.add(1, 7, posture(5), 0);
  EXPECT_EQ(tracker.supersede(StopMotion{}).size(), 1u);
  tracker.add(1, 8, joint_change(6), 0);
  EXPECT_TRUE(tracker.supersede(joint_change(7).command).empty()) << "joint changes add up";
  EXPECT_EQ(tracker.supersede(WalkVelocity{}).size(), 1u);
}

TEST(CommandTracker, KeepsWhatWasHeardWhenANewerCommandComes) {
  CommandTracker tracker{GatewayLimits{}};
  tracker.add(1, 7, posture(5), 0);
  (void)tracker.answer("phone", 5, CommandStatus::kAccepted);
  EXPECT_TRUE(tracker.supersede(StopMotion{}).empty());
  EXPECT_EQ(tracker.answer("phone", 5, CommandStatus::kInterrupted)->request_id, 7u);
}

TEST(CommandTracker, StaysSmall) {
  CommandTracker tracker{GatewayLimits{}};
  for (int64_t i = 1; i <= 1000; ++i) tracker.add(1, 1, posture(i), 0);
  EXPECT_LE(tracker.size(), 256u);
}

}  // namespace
}  // namespace nao
