#include "daemons/vision/line_detector.h"

#include <gmock/gmock.h>

#include <cmath>

#include "daemons/vision/line_continuation.h"
#include "daemons/vision/line_points.h"

namespace nao::vision {
namespace {

const CameraGeometry kNoPose(CameraCalibration::guess(640, 480), std::nullopt);

/** Points that rows of the image would see of a line 10 pixels wide. */
struct Points {
  std::vector<LinePoint> points;
  std::vector<cv::Point2f> ideal;

  void add(float x, float y) {
    points.push_back({{x, y}, {x - 5, y}, {x + 5, y}});
    ideal.emplace_back(x, y);
  }
};

TEST(LineDetector, TakesNoFewScatteredPointsForALine) {
  Points dense;
  for (int i = 0; i < 12; ++i) dense.add(300, static_cast<float>(100 + 8 * i));
  EXPECT_EQ(LineDetector().detect(dense.points, dense.ideal, kNoPose).size(), 1u);
  // Every third or fourth row only: unrelated things that lie in a row.
  Points sparse;
  for (int i = 0; i < 7; ++i) sparse.add(300, static_cast<float>(100 + 28 * i));
  EXPECT_TRUE(LineDetector().detect(sparse.points, sparse.ideal, kNoPose).empty());
  EXPECT_EQ(sparse.points.size(), 7u) << "they may continue another segment";
}

// A straight part of 15 points is followed by a bend in which no five points lie on a line.
TEST(LineContinuation, FollowsABendAsFarAsItsPointsReach) {
  Points bend;
  const cv::Point2f center(200, 200);
  constexpr float kRadius = 60;
  std::vector<cv::Point2f> arc;
  for (float angle = 0.13f; angle < 1.5f; angle += 0.13f) {
    arc.push_back(center + kRadius * cv::Point2f(std::cos(angle), std::sin(angle)));
    bend.add(arc.back().x, arc.back().y);
  }
  bend.add(420, 300);  // unrelated
  const LineSegment straight{{260, 80}, {260, 200}, 15, 10};
  const auto pieces = continue_segments({straight}, bend.points, bend.ideal);
  ASSERT_GE(pieces.size(), 2u);
  EXPECT_NEAR(cv::norm(pieces.front().from - straight.to), 0, 1e-3);
  EXPECT_LT(cv::norm(pieces.back().to - arc.back()), 20);
  for (const LineSegment& piece : pieces) {
    const cv::Point2f middle = 0.5f * (piece.from + piece.to);
    EXPECT_NEAR(cv::norm(middle - center), kRadius, 4);
  }
}

TEST(LineContinuation, NeedsAStrongSegmentAndSimilarWidth) {
  Points ahead;
  for (int i = 1; i < 5; ++i) ahead.add(260, static_cast<float>(200 + 8 * i));
  const LineSegment strong{{260, 80}, {260, 200}, 15, 10};
  EXPECT_EQ(continue_segments({strong}, ahead.points, ahead.ideal).size(), 1u);
  LineSegment weak = strong;
  weak.num_points = 5;
  EXPECT_TRUE(continue_segments({weak}, ahead.points, ahead.ideal).empty());
  LineSegment wide = strong;
  wide.width = 40;
  EXPECT_TRUE(continue_segments({wide}, ahead.points, ahead.ideal).empty());
}

/** The view of an image of one color per column. */
FieldView view_of(const std::vector<cv::Vec3b>& columns) {
  FieldView view;
  view.smooth.create(480, static_cast<int>(columns.size()));
  for (int y = 0; y < view.smooth.rows; ++y) {
    std::copy(columns.begin(), columns.end(), view.smooth[y]);
  }
  view.other = cv::Mat_<uint8_t>(240, static_cast<int>(columns.size() / 2), uint8_t{0});
  view.top.assign(columns.size() / 2, 0);
  view.index = 0.5f;
  view.threshold = 0.2f;
  return view;
}

// A blurred line is green and fades to one side; single pixels in it are as green as the field.
TEST(LinePoints, SeeTheWholeWidthOfAFadingLine) {
  const cv::Vec3b field(60, 140, 60);
  const cv::Vec3b bright(150, 200, 150);
  const cv::Vec3b dim(115, 175, 115);
  std::vector<cv::Vec3b> columns(640, field);
  for (int x = 300; x < 320; ++x) columns[x] = bright;
  for (int x = 320; x < 340; ++x) columns[x] = dim;
  columns[310] = columns[328] = field;
  const auto points = find_line_points(view_of(columns));
  ASSERT_EQ(points.size(), 60u);
  EXPECT_NEAR(points[0].first.x, 300, 1);
  EXPECT_NEAR(points[0].last.x, 340, 1);
}

// The line ends where the field in the sun begins, though that is brighter than the shadow.
TEST(LinePoints, EndAtFieldInAnotherLight) {
  std::vector<cv::Vec3b> columns(640, cv::Vec3b(20, 60, 20));
  for (int x = 300; x < 320; ++x) columns[x] = cv::Vec3b(190, 200, 190);
  for (int x = 320; x < 640; ++x) columns[x] = cv::Vec3b(80, 170, 80);
  const auto points = find_line_points(view_of(columns));
  ASSERT_EQ(points.size(), 60u);
  EXPECT_NEAR(points[0].last.x, 320, 1);
}

}  // namespace
}  // namespace nao::vision
