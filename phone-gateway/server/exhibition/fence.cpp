#include "phone-gateway/server/exhibition/fence.h"

#include <algorithm>
#include <cmath>

namespace nao::gateway {
namespace {

/** Distance of the torso from the border at which a walk towards it stops, m: half of the sway and
 * of the last step. Chosen; exhibition_test.mjs walks against it. */
constexpr double kStopDistance = 0.10;
/** Distance from there over the highest velocity towards the border, s: a walk needs two steps of
 * about 0.5 s to follow a slower command. Chosen. */
constexpr double kBrakeTime = 1.5;
/** Corrections of a velocity in a corner, where one edge's may turn it towards the other. Chosen.
 */
constexpr int kNumRounds = 4;

GroundPoint closest_on_segment(const GroundPoint& point, const GroundPoint& a,
                               const GroundPoint& b) {
  const double dx = b.x - a.x;
  const double dy = b.y - a.y;
  const double length2 = dx * dx + dy * dy;
  if (length2 == 0) return a;
  const double t = std::clamp(((point.x - a.x) * dx + (point.y - a.y) * dy) / length2, 0.0, 1.0);
  return {a.x + t * dx, a.y + t * dy};
}

/** On which side of the line through a and b a point is: its sign. */
double side(const GroundPoint& a, const GroundPoint& b, const GroundPoint& point) {
  return (b.x - a.x) * (point.y - a.y) - (b.y - a.y) * (point.x - a.x);
}

}  // namespace

bool do_cross(const GroundPoint& a, const GroundPoint& b, const GroundPoint& c,
              const GroundPoint& d) {
  return side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0;
}

// Ray casting: https://wrfranklin.org/Research/Short_Notes/pnpoly.html
bool Fence::contains(const GroundPoint& point) const {
  bool is_inside = false;
  for (size_t i = 0, j = corners_.size() - 1; i < corners_.size(); j = i++) {
    const GroundPoint& a = corners_[i];
    const GroundPoint& b = corners_[j];
    if ((a.y > point.y) != (b.y > point.y) &&
        point.x < (b.x - a.x) * (point.y - a.y) / (b.y - a.y) + a.x) {
      is_inside = !is_inside;
    }
  }
  return is_inside;
}

WalkCommand Fence::limit(const WalkCommand& velocity, const GroundPose& robot) const {
  if (!is_set()) return velocity;
  const double c = std::cos(robot.theta);
  const double s = std::sin(robot.theta);
  const GroundPoint place{robot.x, robot.y};
  const bool is_inside = contains(place);
  GroundPoint v{c * velocity.vx - s * velocity.vy, s * velocity.vx + c * velocity.vy};
  bool is_allowed = false;
  for (int round = 0; round < kNumRounds && !is_allowed; ++round) {
    is_allowed = true;
    GroundPoint nearest;
    double least = INFINITY;
    for (size_t i = 0; i < corners_.size(); ++i) {
      const GroundPoint border =
          closest_on_segment(place, corners_[i], corners_[(i + 1) % corners_.size()]);
      const double distance = std::hypot(border.x - place.x, border.y - place.y);
      if (distance < least) {
        least = distance;
        nearest = border;
      }
      if (!is_inside || distance < 1e-9) continue;
      const GroundPoint out{(border.x - place.x) / distance, (border.y - place.y) / distance};
      // Within the stop distance the robot is led back.
      const double allowed = (distance - kStopDistance) / kBrakeTime;
      const double excess = v.x * out.x + v.y * out.y - allowed;
      if (excess <= 1e-9) continue;
      v = {v.x - excess * out.x, v.y - excess * out.y};
      is_allowed = false;
    }
    // Outside, or on the border: nothing that leads away from it.
    if (is_inside && least >= 1e-9) continue;
    const double inward = v.x * (nearest.x - place.x) + v.y * (nearest.y - place.y);
    if (inward <= 0) return {0, 0, velocity.wz};
  }
  if (!is_allowed) return {0, 0, velocity.wz};
  return {c * v.x + s * v.y, -s * v.x + c * v.y, velocity.wz};
}

bool Fence::allows_way(const GroundPoint& from, const GroundPoint& to) const {
  if (!is_set()) return true;
  if (!contains(from) || !contains(to)) return false;
  for (size_t i = 0; i < corners_.size(); ++i) {
    const GroundPoint& a = corners_[i];
    const GroundPoint& b = corners_[(i + 1) % corners_.size()];
    const GroundPoint border = closest_on_segment(to, a, b);
    if (do_cross(from, to, a, b) || std::hypot(border.x - to.x, border.y - to.y) < kStopDistance) {
      return false;
    }
  }
  return true;
}

}  // namespace nao::gateway
