#include "daemons/vision/camera_geometry.h"

#include <gtest/gtest.h>

#include <limits>

namespace nao::vision {
namespace {

Eigen::Isometry3d camera_pose() {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() << 0.05, 0.01, 0.5;
  pose.linear() = (Eigen::AngleAxisd(0.2, Eigen::Vector3d::UnitZ()) *
                   Eigen::AngleAxisd(0.4, Eigen::Vector3d::UnitY()) *
                   Eigen::AngleAxisd(0.05, Eigen::Vector3d::UnitX()))
                      .matrix();
  return pose;
}

CameraCalibration distorted_camera() {
  CameraCalibration calibration = CameraCalibration::guess(640, 480);
  calibration.distortion = {-0.12, 0.03, 0.001, -0.002, 0.01};
  return calibration;
}

TEST(CameraGeometry, LocatesWhatItProjects) {
  const CameraGeometry geometry(distorted_camera(), camera_pose());
  for (const double x : {0.7, 1.0, 2.0, 4.0}) {
    const auto pixel = geometry.project({x, 0.2 * x, 0});
    ASSERT_TRUE(pixel);
    const auto ground = geometry.locate(geometry.undistorted(*pixel));
    ASSERT_TRUE(ground);
    // Single precision of the pixels.
    EXPECT_NEAR(ground->position.x(), x, 2e-3 * x);
    EXPECT_NEAR(ground->position.y(), 0.2 * x, 2e-3 * x);
  }
}

TEST(CameraGeometry, UncertaintyGrowsWithDistance) {
  const CameraGeometry geometry(CameraCalibration::guess(640, 480), camera_pose());
  double last = 0;
  for (const double x : {0.7, 1.5, 3.0, 5.0}) {
    const auto ground = geometry.locate(*geometry.project({x, 0, 0}));
    ASSERT_TRUE(ground);
    EXPECT_GT(ground->covariance.trace(), last);
    EXPECT_GT(ground->covariance.determinant(), 0);
    last = ground->covariance.trace();
  }
}

TEST(CameraGeometry, FindsNoGroundAboveTheHorizon) {
  const CameraGeometry geometry(CameraCalibration::guess(640, 480), camera_pose());
  const auto row = geometry.horizon_row(320);
  ASSERT_TRUE(row);
  const auto above = static_cast<float>(*row - 2);
  EXPECT_FALSE(geometry.at_height({320, above}, 0));
  EXPECT_FALSE(
      CameraGeometry(CameraCalibration::guess(640, 480), std::nullopt).at_height({320, 400}, 0));
}

TEST(CameraGeometry, DoesNotProjectWhatTheLensCannotShow) {
  CameraCalibration calibration = CameraCalibration::guess(640, 480);
  calibration.distortion[0] = -0.12;
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation().z() = 0.5;
  const CameraGeometry geometry(calibration, pose);
  // 45 degrees to the side: beyond the image, but monotonic.
  EXPECT_TRUE(geometry.project({1, 1, 0.5}));
  // 70 degrees: the polynomial is -0.25 there, which would be a pixel on the other side.
  EXPECT_FALSE(geometry.project({1, 2.75, 0.5}));
  EXPECT_FALSE(geometry.project({1, 2, 0.5}));
}

TEST(CameraCalibration, RejectsNonFiniteAndZero) {
  CameraCalibration calibration = CameraCalibration::guess(640, 480);
  EXPECT_TRUE(calibration.is_valid());
  calibration.fx = 0;
  EXPECT_FALSE(calibration.is_valid());
  calibration = CameraCalibration::guess(640, 480);
  calibration.distortion[2] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(calibration.is_valid());
}

}  // namespace
}  // namespace nao::vision
