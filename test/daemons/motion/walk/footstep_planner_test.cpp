#include "daemons/motion/walk/footstep_planner.h"

#include <gtest/gtest.h>

#include "test/daemons/motion/walk/nao_gait.h"

namespace nao::motion {
namespace {

class FootstepPlannerTest : public testing::Test {
 protected:
  const Gait& gait_ = nao_gait();
  FootstepPlanner planner_{nao_model(), gait_};
};

TEST_F(FootstepPlannerTest, TwoStepsCoverTwiceTheVelocityTimesTheDuration) {
  const double duration = gait_.timing.step_duration;
  const std::vector<Eigen::Vector3d> velocities = {{0.2, 0, 0},   {-0.1, 0, 0}, {0, 0.12, 0},
                                                   {0, -0.12, 0}, {0, 0, 0.8},  {0.1, 0.05, -0.3}};
  for (const Eigen::Vector3d& velocity : velocities) {
    for (const bool support_is_left : {true, false}) {
      const Spread spread = planner_.spread_for(velocity);
      const auto steps = planner_.plan(support_is_left, spread, velocity, duration, 2);
      ASSERT_EQ(steps.size(), 2u);
      EXPECT_EQ(steps[0].is_left, !support_is_left);
      EXPECT_EQ(steps[1].is_left, support_is_left);
      // The support foot moves as the body does, seen from the body.
      const Pose2 body = planner_.foot_in_body(support_is_left, spread);
      const Pose2 moved = body * steps[1].pose * body.inverse();
      const Pose2 advance{velocity.head<2>() * duration, velocity.z() * duration};
      const Pose2 expected = advance * advance;
      // A foot that turns too near to the other one is placed some millimeters farther out.
      const double allowed = velocity.z() != 0 ? 0.005 : 1e-9;
      EXPECT_NEAR((moved.position - expected.position).norm(), 0, allowed) << velocity.transpose();
      EXPECT_NEAR(moved.heading, expected.heading, 1e-9) << velocity.transpose();
    }
  }
}

TEST_F(FootstepPlannerTest, ClipsAStepToTheLimitsWithoutContactOfTheFeet) {
  const Gait::StepLimits& limits = gait_.step_limits;
  for (int i = 0; i < 2000; ++i) {
    const Pose2 desired{{0.3 * std::sin(i * 1.1), 0.3 * std::sin(i * 1.7)}, 2 * std::sin(i * 2.3)};
    for (const bool is_left : {true, false}) {
      const Pose2 step = planner_.clip_step(desired, is_left);
      const double side = is_left ? 1 : -1;
      // No corner of the swing sole may be over the inner edge of the support sole.
      const auto& swing =
          is_left ? nao_model().left_sole_outline() : nao_model().right_sole_outline();
      const auto& support =
          is_left ? nao_model().right_sole_outline() : nao_model().left_sole_outline();
      double inner = -1;
      for (const Eigen::Vector2d& corner : support) inner = std::max(inner, side * corner.y());
      double nearest = 1;
      for (const Eigen::Vector2d& corner : swing) {
        nearest = std::min(nearest, side * (step * corner).y());
      }
      EXPECT_GT(nearest, inner) << i;
      EXPECT_LE(step.position.x(), limits.max_forward);
      EXPECT_GE(step.position.x(), -limits.max_backward);
      EXPECT_LE(std::abs(step.heading), std::max(limits.max_turn_outward, limits.max_turn_inward));
    }
  }
}

TEST_F(FootstepPlannerTest, TheBodyOfSquareFeetIsAheadOfTheirMidpoint) {
  const Pose2 right{{1, 2}, 0.5};
  const Pose2 body = body_between(right * planner_.square_step(false), right, 0.03);
  const Pose2 right_in_body = body.inverse() * right;
  EXPECT_NEAR(right_in_body.position.x(), -0.03, 1e-12);
  EXPECT_NEAR(right_in_body.position.y(), -gait_.stance.foot_separation / 2, 1e-12);
  EXPECT_NEAR(right_in_body.heading, 0, 1e-12);
}

}  // namespace
}  // namespace nao::motion
