#include "daemons/vision/checkerboard.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "daemons/vision/patch_sampler.h"

namespace nao::vision {
namespace {

constexpr int kSize = PatchSampler::kSize;

/** Colors alternate between squares, pixels, which are turned by an angle, degrees. */
cv::Mat draw_board(double square, double angle, int dark, int light) {
  cv::Mat large(4 * kSize, 4 * kSize, CV_8UC3);
  const double c = std::cos(angle * M_PI / 180);
  const double s = std::sin(angle * M_PI / 180);
  for (int y = 0; y < large.rows; ++y) {
    for (int x = 0; x < large.cols; ++x) {
      const int column = static_cast<int>(std::floor((c * x + s * y) / (4 * square)));
      const int row = static_cast<int>(std::floor((c * y - s * x) / (4 * square)));
      large.at<cv::Vec3b>(y, x) = cv::Vec3b::all((row + column) % 2 == 0 ? dark : light);
    }
  }
  cv::Mat patch;
  cv::resize(large, patch, {kSize, kSize}, 0, 0, cv::INTER_AREA);
  // A lens and a moving robot blur.
  cv::GaussianBlur(patch, patch, {0, 0}, 0.7);
  return patch;
}

TEST(Checkerboard, IsSeenAtAnySizeAngleAndContrast) {
  for (const double square : {5.4, 7.4, 9.4}) {
    for (const double angle : {0.0, 10.0, 30.0, 45.0, 80.0}) {
      EXPECT_TRUE(is_checkerboard(draw_board(square, angle, 10, 230))) << square << " " << angle;
      EXPECT_TRUE(is_checkerboard(draw_board(square, angle, 90, 130))) << square << " " << angle;
    }
  }
}

TEST(Checkerboard, IsNotSeenInStripesCrossingsOrDarkFacesOfABall) {
  cv::Mat stripes(kSize, kSize, CV_8UC3);
  for (int y = 0; y < kSize; ++y) stripes.row(y) = cv::Scalar::all(y / 6 % 2 == 0 ? 10 : 230);
  EXPECT_FALSE(is_checkerboard(stripes));

  cv::Mat crossings(kSize, kSize, CV_8UC3, cv::Scalar(40, 120, 50));
  for (const int at : {6, 16, 26}) {
    crossings.col(at) = cv::Scalar::all(220);
    crossings.row(at) = cv::Scalar::all(220);
  }
  EXPECT_FALSE(is_checkerboard(crossings));

  cv::Mat ball(kSize, kSize, CV_8UC3, cv::Scalar(40, 120, 50));
  cv::circle(ball, {16, 16}, 13, cv::Scalar::all(220), -1);
  // One dark face in the middle, and around it five that are seen at 63 degrees.
  cv::circle(ball, {16, 16}, 5, cv::Scalar::all(15), -1);
  for (int i = 0; i < 5; ++i) {
    const double angle = 2 * M_PI * i / 5;
    const cv::Point2d at(16 + 11.6 * std::cos(angle), 16 + 11.6 * std::sin(angle));
    cv::ellipse(ball, at, {2, 5}, 72 * i, 0, 360, cv::Scalar::all(15), -1);
  }
  EXPECT_FALSE(is_checkerboard(ball));
  EXPECT_FALSE(is_checkerboard(cv::Mat::zeros(kSize, kSize, CV_8UC3)));
}

}  // namespace
}  // namespace nao::vision
