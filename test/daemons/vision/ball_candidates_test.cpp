#include "daemons/vision/ball_candidates.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace nao::vision {
namespace {

const cv::Scalar kGreenCarpet(40, 120, 45);
/** As far from grey as yellow. */
const cv::Scalar kPaleCarpet(75, 125, 80);
const cv::Scalar kWhitePaint(230, 230, 230);

bool has_place_at(const cv::Mat& image, const Circle& ball) {
  const CameraGeometry geometry(CameraCalibration::guess(image.cols, image.rows), std::nullopt);
  const FieldView view = FieldDetector().detect(image, geometry);
  const std::vector<Circle> places = find_ball_hints(view, geometry, 0.05);
  return std::any_of(places.begin(), places.end(), [&](const Circle& place) {
    return cv::norm(place.center - ball.center) < 0.5f * ball.radius &&
           std::abs(std::log(place.radius / ball.radius)) < 0.4f;
  });
}

TEST(BallCandidates, ContainALargeBallOnALineAmongManySmallWhiteThings) {
  cv::Mat image(480, 640, CV_8UC3, kGreenCarpet);
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 16; ++column) {
      cv::circle(image, {20 + 40 * column, 80 + 30 * row}, 6, kWhitePaint, -1);
    }
  }
  const Circle ball{{320, 330}, 56};
  cv::line(image, {0, 330}, {639, 330}, kWhitePaint, 40);
  cv::circle(image, ball.center, static_cast<int>(ball.radius), {150, 165, 150}, -1);
  EXPECT_TRUE(has_place_at(image, ball));
}

TEST(BallCandidates, ContainBallsFromRedToYellow) {
  for (const cv::Scalar& color :
       {cv::Scalar(30, 40, 200), cv::Scalar(20, 120, 230), cv::Scalar(25, 200, 210)}) {
    cv::Mat image(480, 640, CV_8UC3, kPaleCarpet);
    const Circle ball{{320, 300}, 20};
    cv::circle(image, ball.center, static_cast<int>(ball.radius), color, -1);
    EXPECT_TRUE(has_place_at(image, ball)) << color;
  }
}

}  // namespace
}  // namespace nao::vision
