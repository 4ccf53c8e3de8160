#include "rendering/field_patches.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace nao {
namespace {

const PinholeCamera kCamera = PinholeCamera::from_fov(640, 480, 1.06, 0.83);
constexpr float kReach = 60;

FieldDimensions field() {
  return *SceneFile::find("soccer").field;
}

RenderView view_from(const Eigen::Vector3d& eye, double pitch = 0) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() = eye;
  pose.rotate(Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()));
  return {kCamera, pose};
}

/** Points on the lines, every 5 mm of the straight ones; the edge of the carpet is not among them.
 */
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
      add(side * (x - dimensions.penalty_mark_distance) + t * dimensions.penalty_mark_size / 2, 0);
    }
    const double radius = dimensions.centre_circle_diameter / 2;
    add(radius * std::cos(t * std::numbers::pi), radius * std::sin(t * std::numbers::pi));
  }
  return points;
}

bool is_in_image(const RenderView& view, const Eigen::Vector2f& place) {
  return view.frustum.may_see({place.x(), place.y(), 0}, 0);
}

class FieldPatchesTest : public testing::TestWithParam<Eigen::Vector3d> {
 protected:
  FieldPatchesTest() { patches_.select(view_); }

  FieldPatches patches_{field(), kReach};
  RenderView view_ = view_from(GetParam(), GetParam().z() > 5 ? 1.2 : 0.2);
};

TEST_P(FieldPatchesTest, CoverEveryLineWithAPixelOnBothSides) {
  const auto half_line = static_cast<float>(field().line_width / 2);
  for (const Eigen::Vector2f& point : points_on_lines()) {
    if (!is_in_image(view_, point)) continue;
    const float pixel =
        ((point - view_.eye.head<2>()).squaredNorm() + view_.eye.z() * view_.eye.z()) /
        (view_.pixels_per_radian * view_.eye.z());
    bool is_covered = false;
    for (const GroundPatch& patch : patches_.mixed()) {
      is_covered |= patch.box.contains(point);
    }
    for (const GroundPatch& patch : patches_.lines()) {
      const float away = std::abs(patch.normal.dot(point) - patch.middle);
      if (!patch.box.contains(point) || away > half_line / 2) continue;
      is_covered = true;
      for (const float side : {-1.0f, 1.0f}) {
        EXPECT_TRUE(patch.box.contains(point + side * (half_line + pixel) * patch.normal));
      }
    }
    ASSERT_TRUE(is_covered) << point.transpose();
  }
}

TEST_P(FieldPatchesTest, ShowNoOtherLineBesideAStraightOne) {
  const auto half_line = static_cast<float>(field().line_width / 2);
  for (const GroundPatch& patch : patches_.lines()) {
    for (const Eigen::Vector2f& point : points_on_lines()) {
      const bool is_own =
          !patch.is_edge && std::abs(patch.normal.dot(point) - patch.middle) < 1e-4f;
      if (is_own) continue;
      ASSERT_GT(patch.box.exteriorDistance(point), half_line)
          << "line at " << patch.middle << ", other at " << point.transpose();
    }
  }
}

/** Every point of the ground that is in the image lies in one patch without lines: no gap shows
 * what is behind. */
TEST_P(FieldPatchesTest, CoverTheGroundOnce) {
  for (float x = -kReach + 0.013f; x < kReach; x += 0.371f) {
    for (float y = -kReach + 0.017f; y < kReach; y += 0.373f) {
      if (!is_in_image(view_, {x, y})) continue;
      int count = 0;
      for (const auto* patches : {&patches_.carpet(), &patches_.hall()}) {
        for (const GroundPatch& patch : *patches)
          count += patch.box.contains(Eigen::Vector2f(x, y));
      }
      ASSERT_EQ(count, 1) << x << ", " << y;
    }
  }
}

/** Corners that only touch are rounded apart: single pixels between them showed the carpet. */
TEST_P(FieldPatchesTest, PartsOfALineReachOverEachOther) {
  int num_neighbors = 0;
  for (const GroundPatch& patch : patches_.lines()) {
    for (const GroundPatch& other : patches_.lines()) {
      const bool is_same_line = patch.normal == other.normal && patch.middle == other.middle;
      if (&patch == &other || !is_same_line || !patch.box.intersects(other.box)) continue;
      ++num_neighbors;
      ASSERT_GT(patch.box.intersection(other.box).sizes().minCoeff(), 1e-5f);
    }
  }
  EXPECT_GT(num_neighbors, 0);
}

INSTANTIATE_TEST_SUITE_P(Eyes, FieldPatchesTest,
                         testing::Values(Eigen::Vector3d(0, 0, 0.5), Eigen::Vector3d(-4, 2, 0.3),
                                         Eigen::Vector3d(2.5, -1, 0.5), Eigen::Vector3d(-6, 0, 8)));

/** Near the camera few patches need the shader for everything. */
TEST(FieldPatches, AreMostlyStraightLinesNearTheCamera) {
  FieldPatches patches(field(), kReach);
  patches.select(view_from({2.2, 0, 0.5}));
  EXPECT_GT(patches.lines().size(), patches.mixed().size() / 2);
}

TEST(FieldPatches, AreNoneFromBelow) {
  FieldPatches patches(field(), kReach);
  patches.select(view_from({0, 0, -1}, -0.5));
  EXPECT_TRUE(patches.mixed().empty() && patches.lines().empty() && patches.carpet().empty() &&
              patches.hall().empty());
}

}  // namespace
}  // namespace nao
