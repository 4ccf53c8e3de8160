#include "daemons/play/robot_memory.h"

#include <gtest/gtest.h>

namespace nao::play {
namespace {

using Eigen::Vector2d;

TEST(RobotMemory, RemembersEachRobotOnceAndForgets) {
  RobotMemory memory(PlayParameters::load("").robot_memory);
  memory.add({{1, 0}, {2, 2}}, 10);
  memory.add({{1.1, 0.1}}, 11);
  EXPECT_EQ(memory.positions().size(), 2u);
  memory.forget(12.5);
  ASSERT_EQ(memory.positions().size(), 1u);
  EXPECT_TRUE(memory.positions()[0].isApprox(Vector2d(1.1, 0.1)));
}

TEST(KeepClear, ChangesNothingFarFromRobotsOrAwayFromThem) {
  const WalkCommand walk{0.2, 0.05, 0.3};
  for (const std::vector<Vector2d>& robots : {std::vector<Vector2d>{}, {{2, 0}}, {{-0.5, 0}}}) {
    const WalkCommand clear = keep_clear(walk, robots, {}, PlayParameters::load("").robot_memory);
    EXPECT_EQ(clear.vx, walk.vx);
    EXPECT_EQ(clear.vy, walk.vy);
    EXPECT_EQ(clear.wz, walk.wz);
  }
}

TEST(KeepClear, WalksPastARobotWithoutTouchingIt) {
  const auto parameters = PlayParameters::load("").robot_memory;
  for (const double aside : {-0.2, -0.05, 0.0, 0.05, 0.2}) {
    const Vector2d robot(1.5, aside);
    const Vector2d goal(3, 0);
    Pose2 feet;
    double nearest = 1e9;
    for (int i = 0; i < 600; ++i) {
      const Vector2d way = feet.inverse() * goal;
      WalkCommand walk{0.25 * way.normalized().x(), 0.25 * way.normalized().y(), 0};
      walk = keep_clear(walk, {robot}, feet, parameters);
      feet.position += 0.05 * feet.rotate({walk.vx, walk.vy});
      nearest = std::min(nearest, (feet.position - robot).norm());
    }
    EXPECT_GT(nearest, 0.35) << aside;
    EXPECT_LT((feet.position - goal).norm(), 0.1) << aside;
  }
}

}  // namespace
}  // namespace nao::play
