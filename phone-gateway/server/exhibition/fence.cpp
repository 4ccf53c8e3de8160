#include "phone-gateway/server/exhibition/fence.h"

#include <algorithm>
#include <cmath>

namespace nao::gateway {
namespace {

using Eigen::Vector2d;

/** Distance of the torso from the border at which a walk towards it stops, m: half of the sway and
 * of the last step. Chosen; exhibition_test.mjs walks against it. */
constexpr double kStopDistance = 0.10;
/** Distance from there over the highest velocity towards the border, s: a walk needs two steps of
 * about 0.5 s to follow a slower command. Chosen. */
constexpr double kBrakeTime = 1.5;
/** Corrections of a velocity in a corner, where one edge's may turn it towards the other. Chosen.
 */
constexpr int kNumRounds = 4;

Vector2d closest_on_segment(const Vector2d& point, const Vector2d& a, const Vector2d& b) {
  const Vector2d along = b - a;
  const double length2 = along.squaredNorm();
  if (length2 == 0) return a;
  return a + std::clamp((point - a).dot(along) / length2, 0.0, 1.0) * along;
}

}  // namespace

double side_of_line(const Vector2d& a, const Vector2d& b, const Vector2d& point) {
  return (b.x() - a.x()) * (point.y() - a.y()) - (b.y() - a.y()) * (point.x() - a.x());
}

bool do_cross(const Vector2d& a, const Vector2d& b, const Vector2d& c, const Vector2d& d) {
  return side_of_line(a, b, c) * side_of_line(a, b, d) < 0 &&
         side_of_line(c, d, a) * side_of_line(c, d, b) < 0;
}

// Ray casting: https://wrfranklin.org/Research/Short_Notes/pnpoly.html
bool Fence::contains(const Vector2d& point) const {
  bool is_inside = false;
  for (size_t i = 0, j = corners_.size() - 1; i < corners_.size(); j = i++) {
    const Vector2d& a = corners_[i];
    const Vector2d& b = corners_[j];
    if ((a.y() > point.y()) != (b.y() > point.y()) &&
        point.x() < (b.x() - a.x()) * (point.y() - a.y()) / (b.y() - a.y()) + a.x()) {
      is_inside = !is_inside;
    }
  }
  return is_inside;
}

WalkCommand Fence::limit(const WalkCommand& velocity, const Pose2& robot) const {
  if (!is_set()) return velocity;
  const Vector2d& place = robot.position;
  const bool is_inside = contains(place);
  Vector2d v = robot.rotate({velocity.vx, velocity.vy});
  bool is_allowed = false;
  for (int round = 0; round < kNumRounds && !is_allowed; ++round) {
    is_allowed = true;
    Vector2d nearest = place;
    double least = INFINITY;
    for (size_t i = 0; i < corners_.size(); ++i) {
      const Vector2d border =
          closest_on_segment(place, corners_[i], corners_[(i + 1) % corners_.size()]);
      const double distance = (border - place).norm();
      if (distance < least) {
        least = distance;
        nearest = border;
      }
      if (!is_inside || distance < 1e-9) continue;
      const Vector2d out = (border - place) / distance;
      // Within the stop distance the robot is led back.
      const double allowed = (distance - kStopDistance) / kBrakeTime;
      const double excess = v.dot(out) - allowed;
      if (excess <= 1e-9) continue;
      v -= excess * out;
      is_allowed = false;
    }
    // Outside, or on the border: nothing that leads away from it.
    if (is_inside && least >= 1e-9) continue;
    if (v.dot(nearest - place) <= 0) return {0, 0, velocity.wz};
  }
  if (!is_allowed) return {0, 0, velocity.wz};
  const Vector2d allowed = robot.inverse().rotate(v);
  return {allowed.x(), allowed.y(), velocity.wz};
}

bool Fence::allows_way(const Vector2d& from, const Vector2d& to) const {
  if (!is_set()) return true;
  if (!contains(from) || !contains(to)) return false;
  for (size_t i = 0; i < corners_.size(); ++i) {
    const Vector2d& a = corners_[i];
    const Vector2d& b = corners_[(i + 1) % corners_.size()];
    const Vector2d border = closest_on_segment(to, a, b);
    if (do_cross(from, to, a, b) || (border - to).norm() < kStopDistance) {
      return false;
    }
  }
  return true;
}

}  // namespace nao::gateway
