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
  EXPECT_EQ(monitor.check(scene().bgr, "top", 0, false), ImageStatus::kOk);
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
  EXPECT_EQ(monitor.check(input.bgr, "top", 0, false), ImageStatus::kInverted);
}

TEST(ImageStatus, ACameraThatLooksDownOnTheRobotsBodyIsNotInverted) {
  DrawnField field(0.7);
  VisionInput input = field.input();
  // Feet and trunk, or another robot, over the whole width.
  cv::rectangle(input.bgr, {0, 300, input.bgr.cols, input.bgr.rows - 300}, {200, 200, 200}, -1);
  VisionCore core;
  EXPECT_EQ(core.process(input).image_status, ImageStatus::kOk);
  // Nor is an upside-down camera that looks ahead taken for one that looks down.
  DrawnField ahead(0.0);
  input = ahead.input();
  cv::flip(input.bgr, input.bgr, -1);
  EXPECT_EQ(core.process(input).image_status, ImageStatus::kInverted);
}

TEST(ImageStatus, EqualImagesOfAMovingCameraAreFrozen) {
  const VisionInput input = scene();
  ImageStatusMonitor monitor;
  EXPECT_EQ(monitor.check(input.bgr, "top", 0, true), ImageStatus::kOk);
  EXPECT_EQ(monitor.check(input.bgr, "top", 200000, true), ImageStatus::kOk);
  EXPECT_EQ(monitor.check(input.bgr, "top", 400000, true), ImageStatus::kFrozen);
}

TEST(ImageStatus, EqualImagesOfACameraAtRestAreOk) {
  const VisionInput input = scene();
  ImageStatusMonitor monitor;
  for (int i = 0; i < 20; ++i) {
    EXPECT_EQ(monitor.check(input.bgr, "top", 100000 * i, false), ImageStatus::kOk);
  }
}

}  // namespace
}  // namespace nao::vision
