#pragma once

#include <Eigen/Core>
#include <vector>

namespace nao {

/** Convex hull of points in a plane, counter-clockwise; fewer than three corners if they are on a
 * line.
 *
 * Source: A. M. Andrew, "Another efficient algorithm for convex hulls in two dimensions",
 * Information Processing Letters 9(5), 1979. */
std::vector<Eigen::Vector2d> convex_hull(std::vector<Eigen::Vector2d> points);

/** Signed distance from a point to the edge of a convex polygon, m: positive inside, negative
 * outside, NaN for a polygon without corners. @param polygon  Counter-clockwise. */
double margin_in_polygon(const std::vector<Eigen::Vector2d>& polygon, const Eigen::Vector2d& point);

}  // namespace nao
