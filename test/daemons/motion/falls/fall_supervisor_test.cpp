#include "daemons/motion/falls/fall_supervisor.h"

#include <gtest/gtest.h>

#include "test/daemons/motion/nao_model.h"

namespace nao::motion {
namespace {

using Action = FallSupervisor::Action;
using Ended = FallSupervisor::Ended;

/** A robot whose torso is pitched forward, rad, and at a height, m. */
RobotState pitched_state(double pitch, double height = 0.3) {
  RobotState state;
  state.torso_in_odometry.linear() =
      Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()).toRotationMatrix();
  state.torso_in_odometry.translation().z() = height;
  return state;
}

const RobotState kStanding = pitched_state(0);
const RobotState kLying = pitched_state(1.5, 0.06);
const FallSupervisor::Activity kIdle = {false, true, false};
const FallSupervisor::Activity kWalking = {true, true, true};
const FallSupervisor::Activity kPlayingTransition = {true, false, false};

class FallSupervisorTest : public ::testing::Test {
 protected:
  FallSupervisorTest() { falls_.begin(kStanding); }

  Action update(const RobotState& state, const FallSupervisor::Activity& activity) {
    return falls_.update(state, activity, 0.01);
  }
  /** Steps while nothing runs. @return The first action, if there is one in 10 s. */
  Action wait_idle(const RobotState& state) {
    for (int i = 0; i < 1000; ++i) {
      if (const Action action = update(state, kIdle); action != Action::kNone) return action;
    }
    return Action::kNone;
  }

  MotionOptions options_;
  FallSupervisor falls_{nao_model(), options_};
};

TEST_F(FallSupervisorTest, ProtectsAWalkThatFallsAndGetsUpAfterwards) {
  EXPECT_EQ(update(pitched_state(0.2), kWalking), Action::kNone);
  EXPECT_EQ(update(pitched_state(0.5), kWalking), Action::kProtect);
  EXPECT_TRUE(falls_.has_fallen());
  falls_.note_end(true, Ended::kFall, kLying);
  EXPECT_TRUE(falls_.has_fallen());
  EXPECT_EQ(wait_idle(kLying), Action::kGetUp);
  falls_.note_end(true, Ended::kMotion, kStanding);
  EXPECT_FALSE(falls_.has_fallen());
}

TEST_F(FallSupervisorTest, CountsFallsThatFollowAGetUpAtOnce) {
  const auto fall_and_get_up = [&] {
    EXPECT_EQ(update(pitched_state(0.5), kWalking), Action::kProtect);
    falls_.note_end(true, Ended::kFall, kLying);
    EXPECT_EQ(wait_idle(kLying), Action::kGetUp);
    falls_.note_end(true, Ended::kMotion, kStanding);
  };
  fall_and_get_up();
  EXPECT_EQ(falls_.num_relapses(), 0);
  fall_and_get_up();
  EXPECT_EQ(falls_.num_relapses(), 1);
  fall_and_get_up();
  EXPECT_EQ(falls_.num_relapses(), 2);
  // It has stood for 10 s.
  EXPECT_EQ(wait_idle(kStanding), Action::kNone);
  fall_and_get_up();
  EXPECT_EQ(falls_.num_relapses(), 0);
}

TEST_F(FallSupervisorTest, ATransitionMayLeaveTheFeet) {
  EXPECT_EQ(update(pitched_state(1.2), kPlayingTransition), Action::kNone);
  EXPECT_FALSE(falls_.has_fallen());
}

TEST_F(FallSupervisorTest, ARobotThatAMotionLaidDownHasNotFallen) {
  falls_.note_end(true, Ended::kMotion, kLying);
  EXPECT_EQ(wait_idle(kLying), Action::kNone);
  EXPECT_FALSE(falls_.has_fallen());
}

TEST_F(FallSupervisorTest, ASittingRobotThatIsKnockedOverHasFallen) {
  // Below the height of a stand falls are not predicted.
  EXPECT_EQ(update(pitched_state(0.1, 0.12), kIdle), Action::kNone);
  EXPECT_EQ(wait_idle(kLying), Action::kGetUp);
  EXPECT_TRUE(falls_.has_fallen());
}

TEST_F(FallSupervisorTest, NeedsHelpAfterTheLastTryUntilItIsLifted) {
  update(pitched_state(0.5), kWalking);
  falls_.note_end(true, Ended::kFall, kLying);
  ASSERT_EQ(wait_idle(kLying), Action::kGetUp);
  falls_.note_end(false, Ended::kMotion, kLying);
  EXPECT_TRUE(falls_.needs_help());
  EXPECT_EQ(wait_idle(kLying), Action::kNone);
  EXPECT_TRUE(falls_.needs_help());
  update(kStanding, kIdle);
  EXPECT_FALSE(falls_.needs_help());
}

// Turning the head leaves the robot where it fell; it still gets up, or still needs help.
TEST_F(FallSupervisorTest, AChangeOfJointsEndsNoFall) {
  update(pitched_state(0.5), kWalking);
  falls_.note_end(true, Ended::kFall, kLying);
  falls_.note_end(true, Ended::kJointChange, kLying);
  EXPECT_TRUE(falls_.has_fallen());
  EXPECT_EQ(wait_idle(kLying), Action::kGetUp);
  falls_.note_end(false, Ended::kMotion, kLying);
  falls_.note_end(true, Ended::kJointChange, kLying);
  EXPECT_TRUE(falls_.needs_help());
}

TEST_F(FallSupervisorTest, WithoutGettingUpItStaysDown) {
  options_.gets_up = false;
  update(pitched_state(0.5), kWalking);
  falls_.note_end(true, Ended::kFall, kLying);
  EXPECT_EQ(wait_idle(kLying), Action::kNone);
  EXPECT_TRUE(falls_.has_fallen());
  EXPECT_FALSE(falls_.needs_help());
}

TEST_F(FallSupervisorTest, AnotherRobotNeedsNoHelp) {
  update(pitched_state(0.5), kWalking);
  falls_.note_end(false, Ended::kMotion, kLying);
  ASSERT_TRUE(falls_.needs_help());
  falls_.reset();
  EXPECT_FALSE(falls_.needs_help());
}

}  // namespace
}  // namespace nao::motion
