#include "daemons/vision/image_status.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "drawn_field.h"

namespace nao::vision {
namespace {

VisionInput scene() {
  DrawnField field(0.25);
  field.lines = {{1.5, -3, 1.5, 3}};
  return field.input();
}

TEST(ImageStatus, FieldIsOk) {
  ImageStatusMonitor monitor;
  EXPECT_EQ(monitor.check(PatchSampler(scene().bgr), "top", 0, std::nullopt), ImageStatus::kOk);
}

TEST(ImageStatus, CoveredLensIsReportedWithoutDetections) {
  VisionInput input = scene();
  cv::GaussianBlur(input.bgr, input.bgr, {0, 0}, 120);
  input.bgr *= 0.05;
  VisionCore core;
  const VisionResult result = core.process(input);
  EXPECT_EQ(result.image_status, ImageStatus::kCovered);
  EXPECT_TRUE(result.detections.empty());
}

TEST(ImageStatus, OverexposedImageIsReported) {
  VisionInput input = scene();
  input.bgr *= 6;
  VisionCore core;
  const VisionResult result = core.process(input);
  EXPECT_EQ(result.image_status, ImageStatus::kOverexposed);
  EXPECT_TRUE(result.detections.empty());
}

TEST(ImageStatus, InvertedImageIsReported) {
  DrawnField field(0.0);
  VisionInput input = field.input();
  cv::flip(input.bgr, input.bgr, -1);
  ImageStatusMonitor monitor;
  EXPECT_EQ(monitor.check(PatchSampler(input.bgr), "top", 0, std::nullopt), ImageStatus::kInverted);
}

TEST(ImageStatus, ACameraThatLooksDownOnTheRobotsBodyIsNotInverted) {
  DrawnField field(0.7);
  VisionInput input = field.input();
  // Feet and trunk, or another robot, over the whole width.
  cv::rectangle(input.bgr, {0, 300, input.bgr.cols, input.bgr.rows - 300}, {200, 200, 200}, -1);
  VisionCore core;
  EXPECT_EQ(core.process(input).image_status, ImageStatus::kOk);
  // An upside-down camera that looks ahead is not mistaken for one that looks down either.
  DrawnField ahead(0.0);
  input = ahead.input();
  cv::flip(input.bgr, input.bgr, -1);
  EXPECT_EQ(core.process(input).image_status, ImageStatus::kInverted);
}

/** A pose of a camera that has turned by an angle, rad. */
Eigen::Isometry3d turned(double angle) {
  return Eigen::Isometry3d(Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()));
}

TEST(ImageStatus, EqualImagesOfAMovingCameraAreFrozen) {
  const VisionInput input = scene();
  ImageStatusMonitor monitor;
  EXPECT_EQ(monitor.check(PatchSampler(input.bgr), "top", 0, turned(0)), ImageStatus::kOk);
  EXPECT_EQ(monitor.check(PatchSampler(input.bgr), "top", 200000, turned(0.1)), ImageStatus::kOk);
  EXPECT_EQ(monitor.check(PatchSampler(input.bgr), "top", 400000, turned(0.2)),
            ImageStatus::kFrozen);
  // One pixel that differs is the image of a working camera.
  cv::Mat other = input.bgr.clone();
  other.at<cv::Vec3b>(100, 100)[1] ^= 1;
  EXPECT_EQ(monitor.check(PatchSampler(other), "top", 600000, turned(0.3)), ImageStatus::kOk);
}

TEST(ImageStatus, EqualImagesOfACameraThatSwaysByLessThanAnImageShowsAreOk) {
  const VisionInput input = scene();
  ImageStatusMonitor monitor;
  for (int i = 0; i < 20; ++i) {
    // 0.1 rad/s at the most, 0.002 rad in all.
    EXPECT_EQ(monitor.check(PatchSampler(input.bgr), "top", 100000 * i,
                            turned(i % 2 == 0 ? 0.001 : -0.001)),
              ImageStatus::kOk);
  }
}

TEST(ImageStatus, OfACarpetThatFillsTheImageNothingFollows) {
  const cv::Mat carpet(480, 640, CV_8UC3, cv::Scalar(60, 130, 60));
  ImageStatusMonitor monitor;
  for (int i = 0; i < 20; ++i) {
    EXPECT_EQ(monitor.check(PatchSampler(carpet), "bottom", 100000 * i, turned(0.1 * i)),
              ImageStatus::kOk);
  }
}

}  // namespace
}  // namespace nao::vision
