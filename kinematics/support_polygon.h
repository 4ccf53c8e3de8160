#pragma once

#include <Eigen/Core>
#include <vector>

namespace nao {

/** Convex hull, counter-clockwise, of points in a plane; fewer than three corners if they are on a
 * line. */
std::vector<Eigen::Vector2d> convex_hull(std::vector<Eigen::Vector2d> points);

/** Distance from a point to the edge of a convex polygon (counter-clockwise): positive inside,
 * negative outside, NaN without a polygon. */
double margin_in_polygon(const std::vector<Eigen::Vector2d>& polygon, const Eigen::Vector2d& point);

}  // namespace nao
