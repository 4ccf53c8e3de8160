#include "daemons/motion/walk/velocity_planner.h"

#include <gtest/gtest.h>

#include <cmath>

#include "daemons/motion/walk/speed_limit.h"
#include "test/daemons/motion/walk/nao_gait.h"

namespace nao::motion {
namespace {

using Eigen::Vector3d;

class VelocityPlannerTest : public testing::Test {
 protected:
  VelocityPlanner planner_{nao_model(), nao_gait()};
};

TEST_F(VelocityPlannerTest, ClipsAVelocityAlongItsDirection) {
  const WalkLimits& limits = nao_model().walk_limits();
  EXPECT_TRUE(planner_.clip({9, 0, 0}).isApprox(Vector3d(limits.forward, 0, 0)));
  EXPECT_TRUE(planner_.clip({-9, 0, 0}).isApprox(Vector3d(-limits.backward, 0, 0)));
  const Vector3d commanded(0.5, 0.3, -1);
  const Vector3d clipped = planner_.clip(commanded);
  EXPECT_NEAR(clipped.normalized().dot(commanded.normalized()), 1, 1e-12);
  EXPECT_LT(clipped.x(), limits.forward);
  const Vector3d small(0.02, 0.01, 0.1);
  EXPECT_EQ(planner_.clip(small), small);
}

TEST_F(VelocityPlannerTest, ClipsToAFractionOfTheLimitsWhenSlow) {
  planner_.set_slowness(1);
  const WalkLimits& limits = nao_model().walk_limits();
  const double slow = nao_gait().velocity.slow_speed;
  EXPECT_TRUE(planner_.clip({9, 0, 0}).isApprox(Vector3d(slow * limits.forward, 0, 0)));
  EXPECT_TRUE(planner_.clip({0, 9, 0}).isApprox(Vector3d(0, slow * limits.sideways, 0)));
  const double slow_turning = nao_gait().velocity.slow_turning;
  EXPECT_LT(slow_turning, slow);
  EXPECT_TRUE(planner_.clip({0, 0, 9}).isApprox(Vector3d(0, 0, slow_turning * limits.turning)));
}

TEST_F(VelocityPlannerTest, CombinesLessOfEachDirectionWhenSlow) {
  const WalkLimits& limits = nao_model().walk_limits();
  const Vector3d commanded(limits.forward, limits.sideways, limits.turning);
  // As a part of the limits, each of three equal parts has the size 3^(-1/p).
  const auto& gait = nao_gait().velocity;
  EXPECT_NEAR(planner_.clip(commanded).x() / limits.forward,
              std::pow(3, -1 / gait.envelope_exponent), 1e-12);
  planner_.set_slowness(1);
  const Vector3d slow(gait.slow_speed * limits.forward, gait.slow_speed * limits.sideways,
                      gait.slow_turning * limits.turning);
  EXPECT_TRUE(planner_.clip(slow).isApprox(slow * std::pow(3, -1 / gait.slow_envelope_exponent)));
}

TEST(Slowness, RisesWithTheLag) {
  double last = 0;
  for (double lag = 0.02; lag < 0.08; lag += 0.001) {
    EXPECT_GE(calc_slowness(nao_gait().velocity, lag), last);
    last = calc_slowness(nao_gait().velocity, lag);
  }
  EXPECT_DOUBLE_EQ(calc_slowness(nao_gait().velocity, 0.02), 0);
  EXPECT_DOUBLE_EQ(last, 1);
  EXPECT_LT(nao_gait().velocity.slow_speed, 1);
}

TEST_F(VelocityPlannerTest, ChangesVelocityByALimitedAmountPerStep) {
  const Vector3d next = planner_.ramp({0, 0, 0}, {1, -1, 0.01});
  EXPECT_DOUBLE_EQ(next.x(), nao_gait().velocity.max_change_vx);
  EXPECT_DOUBLE_EQ(next.y(), -nao_gait().velocity.max_change_vy);
  EXPECT_DOUBLE_EQ(next.z(), 0.01);
}

TEST_F(VelocityPlannerTest, AWalkThatEndsChangesItsVelocityAtOnce) {
  for (int i = 0; i < 5; ++i) planner_.begin_step({0.3, 0, 0}, {}, false, false);
  EXPECT_DOUBLE_EQ(planner_.velocity().x(), 0.3);
  planner_.begin_step({0, 0, 0}, {}, true, false);
  EXPECT_EQ(planner_.velocity(), Vector3d(0, 0, 0));
}

TEST_F(VelocityPlannerTest, AddsTheCorrectionThatLeadsBackToThePath) {
  planner_.begin_step({0.1, 0, 0}, {}, false, false);
  for (int i = 0; i < 50; ++i) planner_.advance(0.01);
  // The path is 5 cm ahead; the body is 2 cm behind it and 1 cm to its left, twice.
  for (int i = 0; i < 2; ++i) planner_.begin_step({0.1, 0, 0}, {{0.03, 0.01}, 0}, false, true);
  const double gain = nao_gait().velocity.path_gain;
  EXPECT_DOUBLE_EQ(planner_.velocity().x(), 0.1);
  EXPECT_NEAR(planner_.step_velocity().x(), 0.1 + gain * 0.02, 1e-9);
  EXPECT_NEAR(planner_.step_velocity().y(), -gain * 0.01, 1e-9);
  // A new path begins at the body.
  planner_.begin_step({0.1, 0, 0}, {{0.03, 0.01}, 0}, false, false);
  EXPECT_EQ(planner_.step_velocity(), planner_.velocity());
}

}  // namespace
}  // namespace nao::motion
