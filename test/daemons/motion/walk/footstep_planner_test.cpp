#include "daemons/motion/walk/footstep_planner.h"

#include <gtest/gtest.h>

#include "test/daemons/motion/nao_model.h"

namespace nao::motion {
namespace {

class FootstepPlannerTest : public testing::Test {
 protected:
  Gait gait_ = Gait::load(nao_model().folder() / "gait.yaml");
  FootstepPlanner planner_{nao_model(), gait_};
};

TEST_F(FootstepPlannerTest, TwoStepsCoverTwiceTheVelocityTimesTheDuration) {
  const double duration = gait_.step_duration;
  const std::vector<Eigen::Vector3d> velocities = {{0.2, 0, 0},   {-0.1, 0, 0}, {0, 0.12, 0},
                                                   {0, -0.12, 0}, {0, 0, 0.8},  {0.1, 0.05, -0.3}};
  for (const Eigen::Vector3d& velocity : velocities) {
    for (const bool support_is_left : {true, false}) {
      const Spread spread = planner_.spread_for(velocity);
      const auto steps = planner_.plan(support_is_left, spread, velocity, duration, 2);
      ASSERT_EQ(steps.size(), 2u);
      EXPECT_EQ(steps[0].is_left, !support_is_left);
      EXPECT_EQ(steps[1].is_left, support_is_left);
      // The foot that stood moves as the body does, seen from the body.
      const Pose2 body = planner_.foot_in_body(support_is_left, spread);
      const Pose2 moved = body * steps[1].pose * body.inverse();
      const Pose2 advance{velocity.head<2>() * duration, velocity.z() * duration};
      const Pose2 wished = advance * advance;
      // A foot that turns too near to the other one is set down some millimetres farther out.
      const double allowed = velocity.z() != 0 ? 0.005 : 1e-9;
      EXPECT_NEAR((moved.position - wished.position).norm(), 0, allowed) << velocity.transpose();
      EXPECT_NEAR(moved.heading, wished.heading, 1e-9) << velocity.transpose();
    }
  }
}

TEST_F(FootstepPlannerTest, FeetKeepTheirDistanceWhateverIsWished) {
  for (int i = 0; i < 2000; ++i) {
    const Pose2 wished{{0.3 * std::sin(i * 1.1), 0.3 * std::sin(i * 1.7)}, 2 * std::sin(i * 2.3)};
    for (const bool is_left : {true, false}) {
      const Pose2 step = planner_.clip_step(wished, is_left);
      const double side = is_left ? 1 : -1;
      // No corner of the swinging sole may come over the other sole's inner edge.
      const auto& swing =
          is_left ? nao_model().left_sole_outline() : nao_model().right_sole_outline();
      const auto& stand =
          is_left ? nao_model().right_sole_outline() : nao_model().left_sole_outline();
      double inner = -1;
      for (const Eigen::Vector2d& corner : stand) inner = std::max(inner, side * corner.y());
      double nearest = 1;
      for (const Eigen::Vector2d& corner : swing) {
        nearest = std::min(nearest, side * (step * corner).y());
      }
      EXPECT_GT(nearest, inner) << i;
      EXPECT_LE(step.position.x(), gait_.max_step_forward);
      EXPECT_GE(step.position.x(), -gait_.max_step_backward);
      EXPECT_LE(std::abs(step.heading), std::max(gait_.max_turn_outward, gait_.max_turn_inward));
    }
  }
}

TEST_F(FootstepPlannerTest, ClipsAVelocityAlongItsDirection) {
  const WalkLimits& limits = nao_model().walk_limits();
  EXPECT_TRUE(planner_.clip_velocity({9, 0, 0}).isApprox(Eigen::Vector3d(limits.forward, 0, 0)));
  EXPECT_TRUE(planner_.clip_velocity({-9, 0, 0}).isApprox(Eigen::Vector3d(-limits.backward, 0, 0)));
  const Eigen::Vector3d wish(0.5, 0.3, -1);
  const Eigen::Vector3d clipped = planner_.clip_velocity(wish);
  EXPECT_NEAR(clipped.normalized().dot(wish.normalized()), 1, 1e-12);
  EXPECT_LT(clipped.x(), limits.forward);
  const Eigen::Vector3d small(0.02, 0.01, 0.1);
  EXPECT_EQ(planner_.clip_velocity(small), small);
}

TEST_F(FootstepPlannerTest, ChangesVelocityByALimitedAmountPerStep) {
  const Eigen::Vector3d next = planner_.ramp_velocity({0, 0, 0}, {1, -1, 0.01});
  EXPECT_DOUBLE_EQ(next.x(), gait_.max_change_forward);
  EXPECT_DOUBLE_EQ(next.y(), -gait_.max_change_sideways);
  EXPECT_DOUBLE_EQ(next.z(), 0.01);
}

}  // namespace
}  // namespace nao::motion
