#include "kinematics/odometry_alignment.h"

#include <gtest/gtest.h>

namespace nao {
namespace {

Eigen::Isometry3d pose(double x, double y, double z, double yaw, double pitch = 0) {
  return Eigen::Translation3d(x, y, z) * Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) *
         Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY());
}

TEST(OdometryAlignment, PutsTheEstimateAtTheTruePositionAndHeading) {
  OdometryAlignment alignment;
  const Eigen::Isometry3d estimated = pose(0.5, 0, 0.32, 0.1, 0.05);
  const Eigen::Isometry3d truth = pose(-1, 2, 0.31, 1.2, 0.02);
  alignment.update(1000, estimated, &truth);
  const Eigen::Isometry3d aligned = alignment.pose_odometry_in_world() * estimated;
  EXPECT_TRUE(projected_on_ground(aligned).isApprox(projected_on_ground(truth), 1e-12));
  EXPECT_NEAR(aligned.translation().z(), 0.32, 1e-12) << "height and tilt stay the estimated ones";
}

TEST(OdometryAlignment, IsDoneOnceUntilTimeRunsBackwardsOrItIsReset) {
  OdometryAlignment alignment;
  const Eigen::Isometry3d estimated = pose(0, 0, 0.3, 0);
  const Eigen::Isometry3d first = pose(1, 0, 0.3, 0);
  const Eigen::Isometry3d later = pose(2, 0, 0.3, 0);
  const auto x = [&] { return alignment.pose_odometry_in_world().translation().x(); };
  alignment.update(1000, estimated, nullptr);
  EXPECT_EQ(x(), 0) << "no true pose";
  alignment.update(2000, estimated, &first);
  alignment.update(3000, estimated, &later);
  EXPECT_NEAR(x(), 1, 1e-12) << "the difference is the error of the estimate";
  alignment.update(1000, estimated, &later);
  EXPECT_NEAR(x(), 2, 1e-12) << "the robot was restarted";
  alignment.reset();
  alignment.update(4000, estimated, &first);
  EXPECT_NEAR(x(), 1, 1e-12);
}

}  // namespace
}  // namespace nao
