#include "daemons/vision/patch_sampler.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>

namespace nao::vision {
namespace {

/** Mean place of the bright pixels, weighted; pixels of the patch. */
cv::Point2d bright_center(const cv::Mat& patch) {
  cv::Mat grey;
  cv::cvtColor(patch, grey, cv::COLOR_BGR2GRAY);
  const cv::Moments moments = cv::moments(grey);
  return {moments.m10 / moments.m00, moments.m01 / moments.m00};
}

TEST(PatchSampler, CentersACircleInAPatchWhateverItsSize) {
  for (const float radius : {4.0f, 10.0f, 25.0f, 60.0f, 110.0f}) {
    cv::Mat image = cv::Mat::zeros(480, 640, CV_8UC3);
    const cv::Point2f center(322.25f, 241.5f);
    // Coordinates with 4 bits behind the point.
    cv::circle(image, cv::Point(cv::Point2f(16 * center.x, 16 * center.y)),
               static_cast<int>(16 * radius), {255, 255, 255}, -1, cv::LINE_AA, 4);
    const cv::Mat patch = PatchSampler(image).sample(center, 2 * radius);
    const cv::Point2d seen = bright_center(patch);
    EXPECT_NEAR(seen.x, 15.5, 0.35) << radius;
    EXPECT_NEAR(seen.y, 15.5, 0.35) << radius;
    // A circle of half of the patch's width fills pi/16 of it; OpenCV draws it half a pixel larger.
    const double area = M_PI / 16 * std::pow(1 + 0.5 / radius, 2);
    EXPECT_NEAR(cv::mean(patch)[0], 255 * area, 5) << radius;
  }
}

TEST(PatchSampler, IsBlackOutsideOfTheImage) {
  const cv::Mat image(480, 640, CV_8UC3, cv::Scalar(90, 100, 110));
  const cv::Mat patch = PatchSampler(image).sample({0, 479}, 32);
  EXPECT_EQ(patch.at<cv::Vec3b>(4, 28), cv::Vec3b(90, 100, 110));
  EXPECT_EQ(patch.at<cv::Vec3b>(4, 4), cv::Vec3b(0, 0, 0));
  EXPECT_EQ(patch.at<cv::Vec3b>(28, 28), cv::Vec3b(0, 0, 0));
}

}  // namespace
}  // namespace nao::vision
