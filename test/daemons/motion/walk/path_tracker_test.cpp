#include "daemons/motion/walk/path_tracker.h"

#include <gtest/gtest.h>

#include <cmath>

namespace nao::motion {
namespace {

TEST(PathTracker, AddsNothingForABodyOnThePath) {
  PathTracker path(0.06);
  path.reset({{1, 2}, 0.5});
  const Eigen::Vector3d velocity(0.2, 0.05, 0.4);
  for (int i = 0; i < 100; ++i) path.advance(velocity, 0.01);
  // End of the arc of 0.4 rad in closed form.
  Eigen::Matrix2d arc;
  arc << std::sin(0.4), std::cos(0.4) - 1, 1 - std::cos(0.4), std::sin(0.4);
  const Eigen::Vector2d displacement = arc / 0.4 * velocity.head<2>();
  const Pose2 body = Pose2{{1, 2}, 0.5} * Pose2{displacement, 0.4};
  EXPECT_LT(path.correct(body, 1.0).norm(), 1e-4);
}

TEST(PathTracker, LeadsABodyBackToThePath) {
  PathTracker path(0.06);
  path.reset({});
  for (int i = 0; i < 10; ++i) path.advance({0.3, 0, 0}, 0.01);
  path.correct({{0.02, 0.01}, 0.05}, 2.0);
  const Eigen::Vector3d added = path.correct({{0.02, 0.01}, 0.05}, 2.0);
  EXPECT_NEAR(added.x(), 2 * 0.01, 2e-3);
  EXPECT_NEAR(added.y(), -2 * 0.01, 2e-3);
  EXPECT_NEAR(added.z(), -2 * 0.05, 1e-9);
}

TEST(PathTracker, HoldsTheHeadingOfARobotThatTurnsByItself) {
  // A body that turns by 0.1 rad/s too much, with touchdowns every 0.25 s.
  PathTracker path(0.06);
  path.reset({});
  double heading = 0;
  double added = 0;
  for (int step = 0; step < 200; ++step) {
    path.advance({0, 0, 0}, 0.25);
    heading += 0.25 * (0.1 + added);
    added = path.correct({{0, 0}, heading}, 0.5).z();
  }
  EXPECT_NEAR(added, -0.1, 1e-3);
  EXPECT_NEAR(heading, 0.1 / 0.5, 1e-2);
}

TEST(PathTracker, DropsAnErrorBeyondItsLimits) {
  PathTracker path(0.06);
  path.reset({});
  const Pose2 carried{{-3, 1}, 2};
  path.correct(carried, 1.0);
  const Eigen::Vector3d added = path.correct(carried, 1.0);
  EXPECT_LT(added.head<2>().norm(), 0.1);
  EXPECT_LT(std::abs(added.z()), 0.6);
  // Nor does it return later.
  for (int i = 0; i < 4; ++i) EXPECT_LT(path.correct(carried, 1.0).head<2>().norm(), 0.1);
}

}  // namespace
}  // namespace nao::motion
