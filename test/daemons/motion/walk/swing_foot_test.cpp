#include "daemons/motion/walk/swing_foot.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace nao::motion {
namespace {

constexpr double kTick = 0.01;

TEST(SwingFoot, RestsOverAFootholdThatMovedDuringTheStep) {
  SwingFoot foot;
  foot.start({{-0.06, -0.1}, 0}, 0);
  Pose2 last = foot.pose();
  double greatest_jump = 0;
  for (int tick = 1; tick <= 20; ++tick) {
    const Pose2 foothold{{tick < 10 ? 0.06 : 0.08, -0.11}, 0.2};
    foot.step(foothold, 0.2 - (tick - 1) * kTick, tick / 20.0, 0.015, kTick);
    greatest_jump = std::max(greatest_jump, (foot.pose().position - last.position).norm());
    last = foot.pose();
  }
  EXPECT_NEAR(foot.pose().position.x(), 0.08, 1e-9);
  EXPECT_NEAR(foot.pose().position.y(), -0.11, 1e-9);
  EXPECT_NEAR(foot.pose().heading, 0.2, 1e-9);
  EXPECT_NEAR(foot.height(), 0, 1e-12);
  // A cubic over 0.14 m in 0.2 s is at 1.05 m/s at most; the moved foothold needs a little more.
  EXPECT_LT(greatest_jump, 1.3 * kTick);
}

TEST(SwingFoot, ItsForwardVelocityIsAlongItsOwnHeading) {
  SwingFoot foot;
  foot.start({{-0.06, -0.1}, M_PI / 2}, 0);
  double distance = 0;
  for (int tick = 0; tick < 10; ++tick) {
    distance += 0.5 * kTick * foot.forward_velocity();
    foot.step({{-0.06, -0.02}, M_PI / 2}, 0.2 - tick * kTick, 0.5, 0.015, kTick);
    distance += 0.5 * kTick * foot.forward_velocity();
  }
  EXPECT_GT(foot.forward_velocity(), 0.5);
  EXPECT_NEAR(distance, foot.pose().position.y() + 0.1, 1e-3);
}

TEST(SwingFoot, ReachesItsLiftAtMidSwingAndTheGroundAtTheEnd) {
  SwingFoot foot;
  foot.start({{0, -0.1}, 0}, 0.004);
  foot.step({{0, -0.1}, 0}, 0.1, 0.5, 0.015, kTick);
  EXPECT_NEAR(foot.height(), 0.015 + 0.002, 1e-12);
  foot.step({{0, -0.1}, 0}, 0.0, 1.0, 0.015, kTick);
  EXPECT_NEAR(foot.height(), 0, 1e-12);
}

}  // namespace
}  // namespace nao::motion
