#include "phone-gateway/server/exhibition/fence.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace nao::gateway {
namespace {

const std::vector<Eigen::Vector2d> kSquare{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
const std::vector<Eigen::Vector2d> kCornered{{-1, -1}, {1, -1}, {1, 1}, {0, 1}, {0, 0}, {-1, 0}};

TEST(Fence, LeavesAWalkInTheMiddleAsItIs) {
  const WalkCommand walk = Fence(kSquare).limit({0.3, 0.1, 0.5}, {{0, 0}, 1});
  EXPECT_NEAR(walk.vx, 0.3, 1e-9);
  EXPECT_NEAR(walk.vy, 0.1, 1e-9);
}

TEST(Fence, SlowsToZeroTowardsTheBorderAndLetsAlongAndBack) {
  const Fence fence(kSquare);
  EXPECT_LT(fence.limit({0.3, 0, 0}, {{0.8, 0}, 0}).vx, 0.15);
  EXPECT_NEAR(fence.limit({0.3, 0, 0}, {{0.9, 0}, 0}).vx, 0, 1e-9);
  EXPECT_LT(fence.limit({0.3, 0, 0}, {{0.95, 0}, 0}).vx, 0) << "it is led back";
  EXPECT_NEAR(fence.limit({0, 0.1, 0}, {{0.95, 0}, 0}).vy, 0.1, 1e-9);
  EXPECT_NEAR(fence.limit({-0.3, 0, 0}, {{0.95, 0}, 0}).vx, -0.3, 1e-9);
  EXPECT_NEAR(fence.limit({0.3, 0, 0.4}, {{0, 0.9}, M_PI / 2}).vx, 0, 1e-9);
  EXPECT_EQ(fence.limit({0.3, 0, 0.4}, {{0, 0.9}, M_PI / 2}).wz, 0.4);
}

TEST(Fence, LetsARobotOutsideOnlyBack) {
  const Fence fence(kSquare);
  EXPECT_EQ(fence.limit({0.3, 0, 0.2}, {{1.5, 0}, 0}).vx, 0);
  EXPECT_EQ(fence.limit({-0.3, 0, 0.2}, {{1.5, 0}, 0}).vx, -0.3);
}

TEST(Fence, KnowsWaysThatLeadOut) {
  const Fence fence(kCornered);
  EXPECT_TRUE(fence.allows_way({-0.5, -0.5}, {0.5, 0.5}));
  EXPECT_FALSE(fence.allows_way({-0.8, -0.2}, {0.5, 0.9})) << "over the corner";
  EXPECT_FALSE(fence.allows_way({0.5, 0.5}, {2, 0.5}));
}

// A robot that follows commands with the lag of two steps, and a driver that does anything.
TEST(Fence, HoldsARobotThatFollowsSlowlyWhateverTheDriverDoes) {
  for (const auto& corners : {kSquare, kCornered}) {
    const Fence fence(corners);
    for (unsigned seed = 1; seed <= 20; ++seed) {
      std::mt19937 random(seed);
      std::uniform_real_distribution<double> uniform(-1, 1);
      Pose2 robot{{0.5, -0.5}, 0};
      WalkCommand request;
      WalkCommand velocity;
      double worst = 0;
      const double dt = 0.02;
      for (int i = 0; i < 50 * 300; ++i) {
        if (i % 100 == 0)
          request = {0.35 * uniform(random), 0.2 * uniform(random), uniform(random)};
        const WalkCommand allowed = fence.limit(request, robot);
        velocity.vx += dt / 0.4 * (allowed.vx - velocity.vx);
        velocity.vy += dt / 0.4 * (allowed.vy - velocity.vy);
        robot.heading += dt * request.wz;
        robot.position += dt * robot.rotate({velocity.vx, velocity.vy});
        const auto& [x, y] = std::pair(robot.position.x(), robot.position.y());
        if (!fence.contains(robot.position)) {
          worst = std::max({worst, std::abs(x) - 1, std::abs(y) - 1,
                            corners.size() == 6 ? std::min(-x, y) : 0.0});
        }
      }
      EXPECT_LE(worst, 0.1) << "seed " << seed;
    }
  }
}

}  // namespace
}  // namespace nao::gateway
