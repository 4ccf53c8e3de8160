#include "daemons/motion/estimator/orientation_filter.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/constants.h"

namespace nao::motion {
namespace {

using Eigen::AngleAxisd;
using Eigen::Quaterniond;
using Eigen::Vector3d;

/** What the accelerometer of a resting robot measures. */
Vector3d gravity_in(const Quaterniond& orientation) {
  return orientation.conjugate() * Vector3d(0, 0, kGravity);
}

Quaterniond pitched(double angle) {
  return Quaterniond(AngleAxisd(angle, Vector3d::UnitY()));
}

double heading_of(const Quaterniond& orientation) {
  const Eigen::Matrix3d R = orientation.toRotationMatrix();
  return std::atan2(R(1, 0), R(0, 0));
}

TEST(OrientationFilter, StartsUprightAsTheAccelerometerMeasuresWithHeadingZero) {
  OrientationFilter filter;
  const Quaterniond orientation = pitched(0.3) * AngleAxisd(-0.2, Vector3d::UnitX());
  filter.update(Vector3d::Zero(), gravity_in(orientation), 0, 0.01);
  EXPECT_NEAR(heading_of(filter.orientation()), 0, 1e-12);
  EXPECT_NEAR((filter.orientation() * gravity_in(orientation)).z(), kGravity, 1e-9);
}

TEST(OrientationFilter, StartsFromTheGivenOrientationInFreeFall) {
  OrientationFilter filter;
  filter.reset(Quaterniond(AngleAxisd(1.0, Vector3d::UnitZ())) * pitched(0.4));
  filter.update(Vector3d::Zero(), {0.1, 0, 0.2}, 0, 0.01);
  EXPECT_LT(filter.orientation().angularDistance(pitched(0.4)), 1e-12);
}

TEST(OrientationFilter, IntegratesTheGyroscopeAtAnyPeriod) {
  for (const double dt : {0.008, 0.01, 0.012}) {
    OrientationFilter filter;
    const Vector3d up(0, 0, kGravity);
    filter.update(Vector3d::Zero(), up, 0, dt);
    for (int i = 0; i < 100; ++i) filter.update({0, 0, 0.5}, up, 0, dt);
    EXPECT_NEAR(heading_of(filter.orientation()), 50 * dt, 1e-9) << dt;
  }
}

TEST(OrientationFilter, ConvergesToGravityWithItsTimeConstant) {
  // Once the bias has been learnt, an error of tilt decays as exp(-k_P t), k_P = 0.5 / s.
  OrientationFilter filter;
  for (int i = 0; i < 200; ++i) filter.update(Vector3d::Zero(), {0, 0, kGravity}, 1, 0.01);
  filter.reset(pitched(0.1));
  filter.update(Vector3d::Zero(), Vector3d::Zero(), 0,
                0.01);  // Without gravity, the filter starts from the given orientation.
  for (int i = 0; i < 200; ++i) filter.update(Vector3d::Zero(), {0, 0, kGravity}, 0, 0.01);
  const double tilt = filter.orientation().angularDistance(Quaterniond::Identity());
  EXPECT_LT(tilt, 0.1 * std::exp(-0.5 * 2.0) * 1.1);
  EXPECT_GT(tilt, 0.1 * std::exp(-0.5 * 2.0) * 0.5);
}

TEST(OrientationFilter, DoesNotFollowAnAccelerometerFarFromGravity) {
  OrientationFilter filter;
  filter.update(Vector3d::Zero(), {0, 0, kGravity}, 0, 0.01);
  for (int i = 0; i < 100; ++i) filter.update(Vector3d::Zero(), {9, 0, 12}, 0, 0.01);
  EXPECT_LT(filter.orientation().angularDistance(Quaterniond::Identity()), 1e-12);
}

TEST(OrientationFilter, LearnsTheBiasAtRestAboutAllAxes) {
  OrientationFilter filter;
  const Vector3d bias(0.01, -0.02, 0.03);
  for (int i = 0; i < 1000; ++i) filter.update(bias, {0, 0, kGravity}, 1, 0.01);
  EXPECT_LT((filter.bias() - bias).norm(), 1e-4);
  EXPECT_LT(filter.angular_velocity().norm(), 1e-4);
}

TEST(OrientationFilter, KnowsTheBiasAfterTheFirstMomentsOfRest) {
  OrientationFilter filter;
  const Vector3d bias(0.01, -0.02, 0.03);
  for (int i = 0; i < 20; ++i) filter.update(bias, {0, 0, kGravity}, 1, 0.01);
  EXPECT_LT((filter.bias() - bias).norm(), 1e-3);
}

// A robot that walks before it has ever rested.
TEST(OrientationFilter, SoonLearnsTheBiasAboutLevelAxesWhileMoving) {
  OrientationFilter filter;
  const Vector3d bias(0.05, 0, 0.01);  // 3 degrees/s about the level axis
  double worst_tilt = 0;
  for (int i = 0; i < 6000; ++i) {
    filter.update(bias, {0, 0, kGravity}, 0, 0.01);
    const double tilt = filter.orientation().angularDistance(
        Quaterniond(AngleAxisd(heading_of(filter.orientation()), Vector3d::UnitZ())));
    worst_tilt = std::max(worst_tilt, tilt);
  }
  EXPECT_LT(worst_tilt, 3 * kDegree);
  EXPECT_NEAR(filter.bias().x(), bias.x(), 1e-3);
  EXPECT_NEAR(filter.bias().z(), 0, 1e-3);
}

TEST(OrientationFilter, LimitsTheBias) {
  OrientationFilter filter;
  for (int i = 0; i < 1000; ++i) filter.update({5, 0, 0}, {0, 0, kGravity}, 1, 0.01);
  EXPECT_LE(filter.bias().x(), 0.1);
}

TEST(OrientationFilter, ReplacesAnEstimateThatContradictsGravityAtRest) {
  OrientationFilter filter;
  filter.update(Vector3d::Zero(), {0, 0, kGravity}, 1, 0.01);
  const Vector3d lying = gravity_in(pitched(M_PI / 2));
  filter.update(Vector3d::Zero(), lying, 1, 0.01);
  EXPECT_NEAR((filter.orientation() * lying).z(), kGravity, 1e-6);
}

}  // namespace
}  // namespace nao::motion
