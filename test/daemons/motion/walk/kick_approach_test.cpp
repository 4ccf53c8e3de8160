#include "daemons/motion/walk/kick_approach.h"

#include <gtest/gtest.h>

#include <cmath>

namespace nao::motion {
namespace {

constexpr double kStep = 0.25;  // s

TEST(KickApproach, KicksABallAtItsBestPlaceAtOnce) {
  EXPECT_EQ(plan_kick_approach({0.01, -0.01}, true, {0.2, 0}, kStep).num_steps, 0);
}

TEST(KickApproach, WaitsForTheKickingFoot) {
  const KickApproach approach = plan_kick_approach({0.01, 0}, false, {0.2, 0}, kStep);
  EXPECT_EQ(approach.num_steps, 1);
}

TEST(KickApproach, EndsWithTheBallBeforeTheKickingFoot) {
  for (const bool kicks_next : {true, false}) {
    for (double x = 0.05; x < 1; x += 0.07) {
      const Eigen::Vector2d offset(x, 0.06);
      const KickApproach approach = plan_kick_approach(offset, kicks_next, {0.2, 0}, kStep);
      EXPECT_EQ(approach.num_steps % 2, kicks_next ? 0 : 1);
      EXPECT_LT((approach.num_steps * kStep * approach.velocity - offset).norm(), 1e-9);
    }
  }
}

TEST(KickApproach, KeepsTheForwardVelocity) {
  const KickApproach approach = plan_kick_approach({0.6, 0}, true, {0.2, 0}, kStep);
  EXPECT_NEAR(approach.velocity.x(), 0.2, 0.02);
}

TEST(KickApproach, ReachesABallAsideInAFewSteps) {
  EXPECT_LE(plan_kick_approach({0.15, -0.1}, true, {0.2, 0}, kStep).num_steps, 8);
}

TEST(KickApproach, WalksBackSlowlyFromABallThatIsTooNear) {
  const KickApproach approach = plan_kick_approach({-0.1, 0}, true, {0.2, 0}, kStep);
  EXPECT_GT(approach.num_steps, 0);
  EXPECT_LT(approach.velocity.x(), 0);
  EXPECT_GE(approach.velocity.x(), -0.1);
}

}  // namespace
}  // namespace nao::motion
