#include "daemons/motion/generators/kick_trajectory.h"

#include <gtest/gtest.h>

#include <limits>

namespace nao::motion {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kUnset = std::numeric_limits<double>::quiet_NaN();
const Vector2d kAnyBall(kUnset, kUnset);

/** A kick of three phases: lift, strike, land. */
Kick make_kick() {
  Kick kick;
  kick.ball = {0.18, 0.05};
  kick.ball_reach = {0.05, 0.025};
  kick.foot_reach = {-0.01, 0.01};
  kick.ball_contact = 0.15;
  kick.strike_duration = {0.6, 0.1};
  kick.strength = 1;
  kick.phases = {{"lift", 0.2, {0.01, 0}, {-0.1, 0.1, 0.04}, 0.2},
                 {"strike", 0.1, {0.01, 0}, {0.15, 0.1, 0.04}, -0.2},
                 {"land", 0.3, {0.01, 0.05}, {0, 0.1, 0}, 0}};
  return kick;
}

KickReference make_stand(double side = 1) {
  return {{0.01, side * 0.05}, {0, side * 0.1, 0}, side * -0.2, 0};
}

KickTrajectory make_trajectory(const Vector2d& ball, bool is_left = true, double strength = 1) {
  static const Kick kick = make_kick();
  KickTrajectory trajectory(kick, is_left, ball, strength);
  trajectory.start_from(make_stand(is_left ? 1 : -1));
  return trajectory;
}

TEST(KickPathOverGround, AirborneFootKeepsItWhenTheSupportFootSlidesAndYaws) {
  const KickReference planned{{0.02, 0}, {0.12, 0.1, 0.04}, 0.03, -0.2};
  const Pose2 start{{1, 2}, 0.5};
  const Pose2 now{{1.01, 1.98}, 0.62};
  const KickReference held = hold_path_over_ground(planned, now.inverse() * start);
  const Vector2d over_ground = now * Vector2d(held.foot.head<2>());
  EXPECT_TRUE(over_ground.isApprox(start * Vector2d(planned.foot.head<2>()), 1e-12));
  EXPECT_NEAR(now.heading + held.foot_heading, start.heading + planned.foot_heading, 1e-12);
  EXPECT_EQ(held.foot.z(), planned.foot.z());
  EXPECT_EQ(held.com, planned.com);
}

TEST(KickPathOverGround, AHeadingNearPiIsTheSmallTurnThatItIs) {
  const KickReference planned{{0.02, 0}, {0.12, 0.1, 0.04}, 0, 0};
  const KickReference held = hold_path_over_ground(planned, {Vector2d::Zero(), 2 * M_PI - 0.1});
  EXPECT_NEAR(held.foot_heading, -0.1, 1e-12);
}

TEST(KickPathOverGround, AFootOnTheGroundMovesWithTheSupportFoot) {
  const KickReference planned{{0.02, 0.05}, {0, 0.1, 0}, 0.1, 0};
  const KickReference held = hold_path_over_ground(planned, {{0.01, 0.02}, 0.1});
  EXPECT_EQ(held.foot, planned.foot);
  EXPECT_EQ(held.foot_heading, planned.foot_heading);
}

TEST(KickTrajectory, BeginsAndEndsInTheStand) {
  const KickTrajectory trajectory = make_trajectory(kAnyBall);
  const KickReference stand = make_stand();
  EXPECT_NEAR(trajectory.duration(), 0.6, 1e-12);
  for (const double time : {0.0, trajectory.duration(), 2 * trajectory.duration()}) {
    const KickReference at = trajectory.at(time);
    EXPECT_EQ(at.com, stand.com) << time;
    EXPECT_EQ(at.foot, stand.foot) << time;
    EXPECT_EQ(at.foot_heading, stand.foot_heading) << time;
  }
}

TEST(KickTrajectory, FootMovesAndPointsAlongTheDirectionOfTheKickDuringTheStrike) {
  const KickTrajectory trajectory = make_trajectory(kAnyBall);
  for (const double time : {0.2, 0.25, 0.3}) {
    EXPECT_EQ(trajectory.at(time).foot.y(), 0.1) << time;
    EXPECT_EQ(trajectory.at(time).foot_heading, 0) << time;
  }
}

TEST(KickTrajectory, ImpactIsWhereTheFootReachesTheBall) {
  for (const double ball_x : {0.15, 0.18, 0.2}) {
    const KickTrajectory trajectory = make_trajectory({ball_x, kUnset});
    EXPECT_NEAR(trajectory.impact().foot.x() + 0.15, ball_x, 1e-12);
    EXPECT_EQ(trajectory.impact().foot_heading, 0);
  }
}

TEST(KickTrajectory, FootSwingsInThePlaneOfTheBall) {
  EXPECT_NEAR(make_trajectory({kUnset, 0.055}).at(0.25).foot.y(), 0.105, 1e-12);
  // Up to its reach.
  EXPECT_NEAR(make_trajectory({kUnset, 0.07}).at(0.25).foot.y(), 0.11, 1e-12);
  EXPECT_NEAR(make_trajectory({kUnset, 0.03}).at(0.25).foot.y(), 0.09, 1e-12);
}

TEST(KickTrajectory, WeakerStrikesTakeLonger) {
  EXPECT_NEAR(make_trajectory(kAnyBall, true, 0).duration(), 1.1, 1e-12);
  EXPECT_NEAR(make_trajectory(kAnyBall, true, 0.5).duration(), 0.85, 1e-12);
}

TEST(KickTrajectory, TheRightFootMirrorsTheLeftOne) {
  const KickTrajectory left = make_trajectory({0.17, 0.06}, true);
  const KickTrajectory right = make_trajectory({0.17, -0.06}, false);
  for (double time = 0; time < 0.65; time += 0.05) {
    const KickReference a = left.at(time);
    const KickReference b = right.at(time);
    EXPECT_TRUE(a.com.isApprox(Vector2d(b.com.x(), -b.com.y()), 1e-12)) << time;
    EXPECT_TRUE(a.foot.isApprox(Vector3d(b.foot.x(), -b.foot.y(), b.foot.z()), 1e-12)) << time;
    EXPECT_NEAR(a.foot_heading, -b.foot_heading, 1e-12) << time;
    EXPECT_NEAR(a.foot_pitch, b.foot_pitch, 1e-12) << time;
  }
}

}  // namespace
}  // namespace nao::motion
