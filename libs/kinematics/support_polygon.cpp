#include "kinematics/support_polygon.h"

#include <algorithm>
#include <limits>

namespace nao {
namespace {

// z component of the cross product: positive where b is to the left of a.
double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

double distance_to_segment(const Eigen::Vector2d& a, const Eigen::Vector2d& b,
                           const Eigen::Vector2d& point) {
  const Eigen::Vector2d along = b - a;
  const double length_squared = along.squaredNorm();
  // Parameter of the nearest point on the line, clamped to the segment.
  const double t =
      length_squared > 0 ? std::clamp((point - a).dot(along) / length_squared, 0.0, 1.0) : 0.0;
  return (point - a - t * along).norm();
}

}  // namespace

std::vector<Eigen::Vector2d> convex_hull(std::vector<Eigen::Vector2d> points) {
  // Andrew's monotone chain: the lower hull from left to right, then the upper one back.
  const auto is_left_of = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
  };
  std::sort(points.begin(), points.end(), is_left_of);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;
  std::vector<Eigen::Vector2d> hull(2 * points.size());
  size_t size = 0;
  // Removes points that do not make a left turn; the hull is counterclockwise and strictly convex.
  const auto add = [&](const Eigen::Vector2d& point, size_t least) {
    while (size >= least + 2 &&
           cross(hull[size - 1] - hull[size - 2], point - hull[size - 2]) <= 0) {
      --size;
    }
    hull[size++] = point;
  };
  for (const Eigen::Vector2d& point : points) add(point, 0);
  // The upper hull must not remove points of the lower one.
  const size_t lower_size = size - 1;
  for (auto point = points.rbegin() + 1; point != points.rend(); ++point) add(*point, lower_size);
  hull.resize(size - 1);
  return hull;
}

// Distance to the nearest edge, m, negative outside; of two points or one always negative or 0.
double margin_in_polygon(const std::vector<Eigen::Vector2d>& polygon,
                         const Eigen::Vector2d& point) {
  if (polygon.empty()) return std::numeric_limits<double>::quiet_NaN();
  double distance = std::numeric_limits<double>::infinity();
  bool is_inside = polygon.size() >= 3;
  for (size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector2d& a = polygon[i];
    const Eigen::Vector2d& b = polygon[(i + 1) % polygon.size()];
    is_inside = is_inside && cross(b - a, point - a) >= 0;
    distance = std::min(distance, distance_to_segment(a, b, point));
  }
  return is_inside ? distance : -distance;
}

}  // namespace nao
