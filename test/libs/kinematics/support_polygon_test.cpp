#include "kinematics/support_polygon.h"

#include <gtest/gtest.h>

#include <cmath>

namespace nao {
namespace {

TEST(SupportPolygon, HullIsCounterClockwiseAndLeavesInnerPointsOut) {
  const auto hull = convex_hull({{0, 0}, {1, 1}, {1, 0}, {0.5, 0.5}, {0, 1}, {0.5, 0}, {1, 1}});
  ASSERT_EQ(hull.size(), 4u);
  double area = 0;
  for (size_t i = 0; i < hull.size(); ++i) {
    const auto& a = hull[i];
    const auto& b = hull[(i + 1) % hull.size()];
    area += (a.x() * b.y() - a.y() * b.x()) / 2;
  }
  EXPECT_NEAR(area, 1.0, 1e-12);
}

TEST(SupportPolygon, MarginIsTheDistanceToTheEdge) {
  const auto square = convex_hull({{0, 0}, {2, 0}, {2, 2}, {0, 2}});
  EXPECT_NEAR(margin_in_polygon(square, {0.5, 1}), 0.5, 1e-12);
  EXPECT_NEAR(margin_in_polygon(square, {2.5, 1}), -0.5, 1e-12);
  EXPECT_NEAR(margin_in_polygon(square, {3, 3}), -std::sqrt(2.0), 1e-12);
  EXPECT_TRUE(std::isnan(margin_in_polygon({}, {0, 0})));
}

}  // namespace
}  // namespace nao
