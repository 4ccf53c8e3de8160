#include "daemons/vision/vision_core.h"

#include <gmock/gmock.h>

#include "common/error.h"
#include "drawn_field.h"

namespace nao::vision {
namespace {

std::vector<Detection> of_kind(const VisionResult& result, Kind kind) {
  std::vector<Detection> found;
  for (const Detection& d : result.detections) {
    if (d.kind == kind) found.push_back(d);
  }
  return found;
}

TEST(VisionCore, FindsTheBallWhereItLies) {
  for (const double distance : {0.5, 1.0, 2.0, 3.0}) {
    DrawnField field(0.45 - 0.1 * distance);
    field.ball = Eigen::Vector2d(distance, 0.1);
    VisionCore core;
    const auto balls = of_kind(core.process(field.input()), Kind::kBall);
    ASSERT_EQ(balls.size(), 1u) << distance;
    EXPECT_LT((balls[0].position - *field.ball).norm(), 0.05 * distance) << distance;
    EXPECT_GT(balls[0].covariance.trace(), 0);
  }
}

TEST(VisionCore, FindsTheBallInAHardShadow) {
  DrawnField field(0.3);
  field.shadow = 0.4;
  field.ball = Eigen::Vector2d(1.2, 0.15);
  VisionCore core;
  EXPECT_EQ(of_kind(core.process(field.input()), Kind::kBall).size(), 1u);
}

TEST(VisionCore, TakesNoLineForABall) {
  DrawnField field(0.3);
  field.shadow = 0.5;
  field.lines = {{1.5, -2, 1.5, 2}, {1.5, 0, 4, 0}, {0.8, -1, 0.8, 1}};
  VisionCore core;
  EXPECT_TRUE(of_kind(core.process(field.input()), Kind::kBall).empty());
}

TEST(VisionCore, FindsLinesAndTheirCrossing) {
  DrawnField field(0.35);
  field.lines = {{1.5, -3, 1.5, 0.3}, {1.5, 0.3, 5, 0.3}};
  VisionCore core;
  const VisionResult result = core.process(field.input());
  EXPECT_GE(of_kind(result, Kind::kLine).size(), 2u);
  const auto crossings = of_kind(result, Kind::kCrossingL);
  ASSERT_EQ(crossings.size(), 1u);
  EXPECT_NEAR(crossings[0].position.x(), 1.5, 0.05);
  EXPECT_NEAR(crossings[0].position.y(), 0.3, 0.05);
}

TEST(VisionCore, FindsTheCenterCircle) {
  DrawnField field(0.35);
  field.circle = Eigen::Vector2d(1.8, 0.1);
  field.lines = {{1.8, -3, 1.8, 3}};
  VisionCore core;
  const auto circles = of_kind(core.process(field.input()), Kind::kCenterCircle);
  ASSERT_EQ(circles.size(), 1u);
  EXPECT_LT((circles[0].position - *field.circle).norm(), 0.08);
}

TEST(VisionCore, KnowsNoPositionsWithoutThePose) {
  DrawnField field(0.3);
  field.ball = Eigen::Vector2d(1.2, 0);
  field.lines = {{2, -2, 2, 2}};
  VisionInput input = field.input();
  input.pose_camera_in_heading.reset();
  VisionCore core;
  const VisionResult result = core.process(input);
  EXPECT_EQ(of_kind(result, Kind::kBall).size(), 1u);
  for (const Detection& d : result.detections) EXPECT_FALSE(d.has_position());
}

TEST(VisionCore, SeesTheSameThroughADistortingLens) {
  DrawnField field(0.3);
  field.ball = Eigen::Vector2d(1.2, 0.4);
  VisionInput input = field.input();
  // The same image, taken as that of a lens that bends by 3 % at the border: the ball's position
  // must move as the lens says.
  VisionCore core;
  const auto plain = of_kind(core.process(input), Kind::kBall);
  input.calibration.distortion[0] = -0.1;
  const auto bent = of_kind(core.process(input), Kind::kBall);
  ASSERT_EQ(plain.size(), 1u);
  ASSERT_EQ(bent.size(), 1u);
  EXPECT_GT(bent[0].position.y(), plain[0].position.y());
}

TEST(VisionCore, TracksTheBallInOdometry) {
  DrawnField field(0.3);
  field.ball = Eigen::Vector2d(1.0, 0);
  VisionInput input = field.input();
  input.heading_in_odometry = Pose2{{2, 3}, M_PI / 2};
  VisionCore core;
  VisionResult result;
  for (int i = 0; i < 5; ++i) {
    input.utime = 66667 * (i + 1);
    result = core.process(input);
  }
  ASSERT_TRUE(result.ball.is_known);
  EXPECT_NEAR(result.ball.state[0], 2, 0.05);
  EXPECT_NEAR(result.ball.state[1], 4, 0.05);
  EXPECT_FALSE(result.ball.is_rolling);
}

TEST(VisionCore, RefusesOtherFormats) {
  VisionCore core;
  VisionInput input;
  EXPECT_THROW(core.process(input), Error);
  input.bgr.create(480, 640, CV_8UC1);
  EXPECT_THROW(core.process(input), Error);
}

}  // namespace
}  // namespace nao::vision
