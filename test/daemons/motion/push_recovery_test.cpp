#include "daemons/motion/push_recovery.h"

#include <gtest/gtest.h>

#include <cmath>

#include "test/daemons/motion/moving_robot.h"

namespace nao::motion {
namespace {

TEST(PushRecovery, IsPushedOffItsSolesInAnyDirection) {
  EXPECT_TRUE(is_pushed_off(moving(0.4, 0), 0.02));
  EXPECT_TRUE(is_pushed_off(moving(0, -0.56), 0.02));
  EXPECT_FALSE(is_pushed_off(moving(0, -0.5), 0.02));
  EXPECT_FALSE(is_pushed_off(moving(0.35, 0), 0.02));
  EXPECT_FALSE(is_pushed_off(moving(0.19, 0), -0.1));
  // Lifted.
  RobotState state;
  state.center_of_mass_velocity_in_odometry = {1, 0, 0};
  EXPECT_FALSE(is_pushed_off(state, 0));
}

TEST(PushRecovery, ARobotAtRestIsPushedOnBothFeet) {
  EXPECT_TRUE(is_pushed_at_rest(moving(0.4, 0)));
  EXPECT_FALSE(is_pushed_at_rest(moving(0.3, 0)));
  RobotState step = moving(0.4, 0);
  step.left_foot_carries = false;
  EXPECT_FALSE(is_pushed_at_rest(step));
}

TEST(PushRecovery, TheFootThatThePushBearsOnSwings) {
  EXPECT_EQ(recovery_lead(moving(0.5, 0.1)), 0);
  EXPECT_EQ(recovery_lead(moving(0.5, -0.1)), 0.5);
  // The capture point is 0.159 m and 0.303 m to the side, the edge 0.15 m.
  EXPECT_EQ(find_outward_lead(moving(0, 0.5), 0.09), std::nullopt);
  EXPECT_EQ(find_outward_lead(moving(0, 0.5), 0), 0);
  EXPECT_EQ(find_outward_lead(moving(0, 0.95), 0.09), 0);
  EXPECT_EQ(find_outward_lead(moving(0, -0.95), 0.09), 0.5);
  EXPECT_EQ(find_outward_lead(moving(2, 0), 0.09), std::nullopt);
}

TEST(PushRecovery, AFootThatSwingsAlreadyGoesOn) {
  RobotState state = moving(0, 0.95);
  state.left_foot_carries = false;
  EXPECT_EQ(find_outward_lead(state, 0.09), std::nullopt);
  state.support_polygon_in_odometry.clear();
  EXPECT_EQ(find_outward_lead(state, 0.09), std::nullopt);
}

TEST(PushRecovery, AWalkIsPushedWhenItsNextStepWouldNotCatchIt) {
  // At its own velocity the capture point is over the soles.
  EXPECT_FALSE(is_walk_pushed(moving(0.8, 0), {0.8, 0, 0}));
  EXPECT_TRUE(is_walk_pushed(moving(2.2, 0), {0.3, 0, 0}));
  EXPECT_FALSE(is_walk_pushed(moving(2.2, 0), {0.8, 0, 0}));
  // Both are 1.2 m/s faster than they walk, which only the fast walk makes up for.
  EXPECT_TRUE(is_walk_pushed(moving(1.5, 0), {0.3, 0, 0}));
  EXPECT_FALSE(is_walk_pushed(moving(2.0, 0), {0.8, 0, 0}));
  EXPECT_TRUE(is_walk_pushed(moving(0.3, 0.7), {0.3, 0, 0}));
  EXPECT_FALSE(is_walk_pushed(moving(0.3, 0.7), {0.3, 0.2, 0}));
}

}  // namespace
}  // namespace nao::motion
