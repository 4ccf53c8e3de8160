#include "rendering/carpet_cells.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace nao {
namespace {

const PinholeCamera kCamera = PinholeCamera::from_fov(640, 480, 1.06, 0.83);

FieldDimensions field() {
  return *SceneFile::find("soccer").field;
}

RenderView view_from(const Eigen::Vector3d& eye) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() = eye;
  return {kCamera, pose};
}

/** Points on the lines, every 5 mm of the straight ones. */
std::vector<Eigen::Vector2f> points_on_lines() {
  const FieldDimensions dimensions = field();
  std::vector<Eigen::Vector2f> points;
  const auto add = [&](double x, double y) { points.emplace_back(x, y); };
  const double x = dimensions.length / 2;
  const double y = dimensions.width / 2;
  for (double t = -1; t <= 1; t += 0.001) {
    add(0, t * y);
    for (const double side : {-1.0, 1.0}) {
      add(t * x, side * y);
      add(side * x, t * y);
      const double penalty = x - dimensions.penalty_area_length;
      const double goal = x - dimensions.goal_area_length;
      add(side * penalty, t * dimensions.penalty_area_width / 2);
      add(side * goal, t * dimensions.goal_area_width / 2);
      for (const double end : {-1.0, 1.0}) {
        add(end * (penalty + (1 + t) / 2 * (x - penalty)),
            side * dimensions.penalty_area_width / 2);
        add(end * (goal + (1 + t) / 2 * (x - goal)), side * dimensions.goal_area_width / 2);
      }
      add(side * (x - dimensions.penalty_mark_distance), t * dimensions.penalty_mark_size / 2);
    }
    const double radius = dimensions.centre_circle_diameter / 2;
    add(radius * std::cos(t * std::numbers::pi), radius * std::sin(t * std::numbers::pi));
  }
  return points;
}

TEST(CarpetCells, HaveNoLines) {
  CarpetCells cells(field());
  for (const Eigen::Vector3d& eye :
       {Eigen::Vector3d(0, 0, 0.5), Eigen::Vector3d(-4, 2, 0.3), Eigen::Vector3d(0, 0, 20)}) {
    const auto half_line = static_cast<float>(field().line_width / 2);
    for (const Eigen::AlignedBox2f& cell : cells.without_lines(view_from(eye))) {
      for (const Eigen::Vector2f& point : points_on_lines()) {
        ASSERT_GT(cell.exteriorDistance(point), half_line)
            << "cell at " << cell.min().transpose() << ", line at " << point.transpose();
      }
    }
  }
}

TEST(CarpetCells, CoverMostOfTheCarpetNearTheCamera) {
  CarpetCells cells(field());
  // Of a square of 2.2 m in front of and beside the camera.
  const Eigen::AlignedBox2f square(Eigen::Vector2f(-2.6f, 0.4f), Eigen::Vector2f(-0.4f, 2.6f));
  double area = 0;
  for (const Eigen::AlignedBox2f& cell : cells.without_lines(view_from({-1.5, 1.5, 0.5}))) {
    if (cell.intersects(square)) area += cell.intersection(square).volume();
  }
  EXPECT_GT(area, 0.6 * 2.2 * 2.2);
}

/** From far away a pixel is longer than the space between lines. */
TEST(CarpetCells, AreFewFromFarAway) {
  CarpetCells cells(field());
  EXPECT_TRUE(cells.without_lines(view_from({-60, 0, 0.5})).empty());
  EXPECT_TRUE(cells.without_lines(view_from({0, 0, -1})).empty());
}

}  // namespace
}  // namespace nao
