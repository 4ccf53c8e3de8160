#include "daemons/motion/guards/tipping_guard.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "kinematics/support_polygon.h"

namespace nao::motion {
namespace {

// Height above the lowest corner up to which a corner is in contact, m. Chosen: what the soles and
// the ground yield under the weight.
constexpr double kContactDepth = 0.002;
// Step of a roll over an edge, and the greatest roll, rad. Chosen: a robot that has rolled by 0.06
// rad (3.4 degrees) does not stop by itself.
constexpr double kRollStep = 0.01;
constexpr double kMaxRoll = 0.06;
// Tilt of a sole against the ground up to which it is flat, rad. Chosen: the greatest roll.
constexpr double kFlat = 0.06;
// Depth below the flat sole to which an edge of the other sole may reach, m; deeper, it lifts the
// body off the flat sole. Chosen: twice the contact depth.
constexpr double kMaxLifting = 0.004;
// Decrease of the flatter sole's cosine below its value at the start that counts as a tilt.
constexpr double kFlatTolerance = 1e-3;
// Greatest error of the measured direction of up, rad (2 degrees): the accelerometer's bias.
constexpr double kUpError = 0.035;
// Area below which three corners are on one line, m^2.
constexpr double kOnLine = 1e-6;
// Difference of cosines up to which two faces have the same normal.
constexpr double kSameNormal = 1e-12;
// Distance of a corner to a face that it is on, m: rounding only.
constexpr double kOnFace = 1e-9;
// Least static stability margin, m: a reserve for accelerations and for the sensors' errors.
// Chosen; NAO's upright postures have 0.03 m and more.
constexpr double kReserve = 0.012;
// Change of the joint that turns most from one sample of the line to the next, rad, and the
// greatest number of samples.
constexpr double kSampleAngle = 0.03;
constexpr int kMaxSamples = 100;
// Slack of comparisons of margins, m: rounding only.
constexpr double kMarginRounding = 1e-9;

/** Horizontal axes for a direction of up, all in the torso frame. */
struct LevelAxes {
  explicit LevelAxes(const Eigen::Vector3d& up)
      : y(up.cross(Eigen::Vector3d::UnitX()).normalized()), x(y.cross(up)) {}

  /** Coordinates of a point on the ground. */
  Eigen::Vector2d project(const Eigen::Vector3d& point) const {
    return {x.dot(point), y.dot(point)};
  }

  /** To the left. */
  Eigen::Vector3d y;
  /** Forward. */
  Eigen::Vector3d x;
};

/** Point on the edge of a convex polygon that is nearest to a point. */
Eigen::Vector2d nearest_on_edge(const std::vector<Eigen::Vector2d>& polygon,
                                const Eigen::Vector2d& point) {
  Eigen::Vector2d nearest = polygon.front();
  for (size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector2d& a = polygon[i];
    const Eigen::Vector2d along = polygon[(i + 1) % polygon.size()] - a;
    const double length_squared = along.squaredNorm();
    const double t =
        length_squared > 0 ? std::clamp((point - a).dot(along) / length_squared, 0.0, 1.0) : 0.0;
    const Eigen::Vector2d candidate = a + t * along;
    if ((candidate - point).squaredNorm() < (nearest - point).squaredNorm()) nearest = candidate;
  }
  return nearest;
}

/** A sole in the torso frame. */
struct Sole {
  /** Away from the ground, unit. */
  Eigen::Vector3d normal;
  std::vector<Eigen::Vector3d> corners;
};

std::array<Sole, 2> find_soles(const Kinematics& kinematics) {
  const RobotModel& model = kinematics.model();
  std::array<Sole, 2> soles;
  for (int side = 0; side < 2; ++side) {
    const Eigen::Isometry3d& pose = side == 0 ? kinematics.left_sole() : kinematics.right_sole();
    soles[side].normal = pose.linear().col(2);
    for (const Eigen::Vector2d& corner :
         side == 0 ? model.left_sole_outline() : model.right_sole_outline()) {
      soles[side].corners.push_back(pose * Eigen::Vector3d(corner.x(), corner.y(), 0));
    }
  }
  return soles;
}

/** Support polygon for a direction of up, in level axes. Sets `flattest` and `lifting`. */
std::vector<Eigen::Vector2d> find_support(const std::array<Sole, 2>& soles,
                                          const Eigen::Vector3d& up, const LevelAxes& axes,
                                          Equilibrium& state) {
  state.flattest = std::max(up.dot(soles[0].normal), up.dot(soles[1].normal));
  // A sole on its edge yields under load: only flat soles support the body, or the flatter one.
  const double flat = std::min(std::cos(kFlat), state.flattest);
  double lowest = std::numeric_limits<double>::infinity();
  double lowest_flat = lowest;
  for (const Sole& sole : soles) {
    for (const Eigen::Vector3d& corner : sole.corners) {
      const double height = up.dot(corner);
      lowest = std::min(lowest, height);
      if (up.dot(sole.normal) >= flat) lowest_flat = std::min(lowest_flat, height);
    }
  }
  state.lifting = lowest_flat - lowest;
  std::vector<Eigen::Vector2d> contacts;
  for (const Sole& sole : soles) {
    if (up.dot(sole.normal) < flat) continue;
    for (const Eigen::Vector3d& corner : sole.corners) {
      if (up.dot(corner) < lowest_flat + kContactDepth) contacts.push_back(axes.project(corner));
    }
  }
  return convex_hull(std::move(contacts));
}

/** Whether a body at rest on a face of its hull stays there: no corner is below the face, and the
 * center of mass projects into it.
 * @param height  Height of the face along up, m. */
bool rests_on(const Eigen::Vector3d& up, double height, const std::vector<Eigen::Vector3d>& corners,
              const Eigen::Vector3d& center_of_mass) {
  const LevelAxes axes(up);
  std::vector<Eigen::Vector2d> face;
  for (const Eigen::Vector3d& corner : corners) {
    if (up.dot(corner) < height - kOnFace) return false;
    if (up.dot(corner) <= height + kOnFace) face.push_back(axes.project(corner));
  }
  return margin_in_polygon(convex_hull(std::move(face)), axes.project(center_of_mass)) >= 0;
}

}  // namespace

Equilibrium TippingGuard::find_equilibrium(const std::vector<double>& position,
                                           const Eigen::Vector3d& up_in_torso) {
  kinematics_.update(position);
  const std::array<Sole, 2> soles = find_soles(kinematics_);
  Equilibrium state;
  state.up_in_torso = up_in_torso;
  for (double rolled = 0;; rolled += kRollStep) {
    const Eigen::Vector3d& up = state.up_in_torso;
    const LevelAxes axes(up);
    const std::vector<Eigen::Vector2d> support = find_support(soles, up, axes, state);
    const Eigen::Vector2d com = axes.project(kinematics_.center_of_mass());
    state.margin = margin_in_polygon(support, com);
    const Eigen::Vector2d to_edge = nearest_on_edge(support, com) - com;
    const double distance = to_edge.norm();
    if (distance > 0) {
      // From inside, the body tips towards the edge; from outside, away from it.
      const double sign = state.margin < 0 ? -1 : 1;
      const Eigen::Vector2d direction = sign / distance * to_edge;
      state.tipping_direction = direction.x() * axes.x + direction.y() * axes.y;
    }
    if (state.margin >= 0 || rolled >= kMaxRoll) return state;
    // A roll towards a direction turns up away from it, seen from the body.
    state.up_in_torso = (up - kRollStep * state.tipping_direction).normalized();
  }
}

Eigen::Vector3d TippingGuard::find_support_normal(const std::vector<double>& position,
                                                  const Eigen::Vector3d& up_in_torso) {
  kinematics_.update(position);
  std::vector<Eigen::Vector3d> corners;
  for (const Sole& sole : find_soles(kinematics_)) {
    corners.insert(corners.end(), sole.corners.begin(), sole.corners.end());
  }
  // The soles have few corners: every plane through three of them is tried.
  Eigen::Vector3d best = up_in_torso;
  double nearest = std::cos(kUpError);
  for (size_t i = 0; i < corners.size(); ++i) {
    for (size_t j = i + 1; j < corners.size(); ++j) {
      for (size_t k = j + 1; k < corners.size(); ++k) {
        Eigen::Vector3d up = (corners[j] - corners[i]).cross(corners[k] - corners[i]);
        if (up.norm() < kOnLine) continue;
        up.normalize();
        if (up.dot(up_in_torso) < 0) up = -up;
        if (up.dot(up_in_torso) <= nearest + kSameNormal) continue;
        if (!rests_on(up, up.dot(corners[i]), corners, kinematics_.center_of_mass())) continue;
        nearest = up.dot(up_in_torso);
        best = up;
      }
    }
  }
  return best;
}

double TippingGuard::find_safe_fraction(const std::vector<double>& from,
                                        const std::vector<double>& to,
                                        const Eigen::Vector3d& up_in_torso, Equilibrium& tipping) {
  double largest = 0;
  for (size_t i = 0; i < from.size(); ++i) largest = std::max(largest, std::abs(to[i] - from[i]));
  const int num_samples =
      std::clamp(static_cast<int>(std::ceil(largest / kSampleAngle)), 1, kMaxSamples);
  const Eigen::Vector3d standing_up = find_support_normal(from, up_in_torso);
  Eigen::Vector3d up = standing_up;
  // A robot with a poor margin at the start may move as long as the margin does not decrease.
  const Equilibrium start = find_equilibrium(from, up);
  double needed_margin = std::min(kReserve, start.margin);
  const double allowed_lifting = std::max(kMaxLifting, start.lifting + kMaxLifting / 4);
  const double needed_flatness = std::min(std::cos(kFlat), start.flattest - kFlatTolerance);
  std::vector<double> position = from;
  for (int k = 1; k <= num_samples; ++k) {
    const double fraction = static_cast<double>(k) / num_samples;
    for (size_t i = 0; i < from.size(); ++i) position[i] = from[i] + fraction * (to[i] - from[i]);
    const Equilibrium state = find_equilibrium(position, up);
    const bool leans = state.up_in_torso.dot(standing_up) < std::cos(kMaxRoll);
    if (state.margin < needed_margin - kMarginRounding || state.flattest < needed_flatness ||
        state.lifting > allowed_lifting || leans) {
      tipping = state;
      return static_cast<double>(k - 1) / num_samples;
    }
    needed_margin = std::min(kReserve, std::max(needed_margin, state.margin));
    up = state.up_in_torso;
  }
  return 1;
}

}  // namespace nao::motion
