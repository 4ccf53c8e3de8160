#include "daemons/motion/guards/tipping_guard.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "kinematics/support_polygon.h"

namespace nao::motion {
namespace {

// Points this little above the lowest one carry weight too: soles and floor give that much, m.
constexpr double kContactDepth = 0.002;
// One step of rolling over an edge, and when it has rolled over for good, rad.
constexpr double kRollStep = 0.01;
constexpr double kMaxRoll = 0.06;
// A sole that leans less than this against the floor is flat, rad.
constexpr double kFlat = 0.06;
// An edge of the other sole may press this far below the flat one, m; more lifts the body off it.
constexpr double kLifting = 0.004;
constexpr double kFlatTolerance = 1e-3;  // of the cosine
// Largest error of the estimated up, rad: bias of the accelerometer, before and after settling.
constexpr double kUpError = 0.035;
// Three corners that span less than this, m^2, are on a line.
constexpr double kOnLine = 1e-6;
// Cosines that differ by less belong to the same face.
constexpr double kNoNearer = 1e-12;
// Corners this far below a face are on it, m: rounding only.
constexpr double kOnFace = 1e-9;
// Reserve for momentum and for what the sensors do not see, m.
constexpr double kReserve = 0.012;
// The way is looked at every so many rad of the joint that turns most.
constexpr double kSampleAngle = 0.03;
constexpr int kMaxSamples = 100;

/** Two unit vectors that are level if `up` is up: x ahead, y to the left. */
void find_level_axes(const Eigen::Vector3d& up, Eigen::Vector3d& x, Eigen::Vector3d& y) {
  y = up.cross(Eigen::Vector3d::UnitX()).normalized();
  x = y.cross(up);
}

/** Point of the polygon's edge that is nearest. */
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

/** True if a body on a face with this up, through these corners, stays there. */
bool rests_on(const Eigen::Vector3d& up, double height, const std::vector<Eigen::Vector3d>& corners,
              const Eigen::Vector3d& center_of_mass) {
  Eigen::Vector3d x;
  Eigen::Vector3d y;
  find_level_axes(up, x, y);
  std::vector<Eigen::Vector2d> face;
  for (const Eigen::Vector3d& corner : corners) {
    if (up.dot(corner) < height - kOnFace) return false;
    if (up.dot(corner) <= height + kOnFace) face.push_back({x.dot(corner), y.dot(corner)});
  }
  const Eigen::Vector2d mass(x.dot(center_of_mass), y.dot(center_of_mass));
  return margin_in_polygon(convex_hull(std::move(face)), mass) >= 0;
}

}  // namespace

TippingGuard::TippingGuard(const RobotModel& model) : kinematics_(model) {}

Rest TippingGuard::find_rest(const std::vector<double>& position,
                             const Eigen::Vector3d& up_in_torso) {
  kinematics_.update(position);
  const std::array<Sole, 2> soles = find_soles(kinematics_);
  Rest rest;
  rest.up_in_torso = up_in_torso;
  for (double rolled = 0;; rolled += kRollStep) {
    const Eigen::Vector3d& up = rest.up_in_torso;
    Eigen::Vector3d x;
    Eigen::Vector3d y;
    find_level_axes(up, x, y);
    rest.flattest = std::max(up.dot(soles[0].normal), up.dot(soles[1].normal));
    // A sole on its edge gives way under load: only the flat ones count, or the one that is nearer
    // to it.
    const double flat = std::min(std::cos(kFlat), rest.flattest);
    double lowest = std::numeric_limits<double>::infinity();
    double lowest_flat = lowest;
    for (const Sole& sole : soles) {
      for (const Eigen::Vector3d& corner : sole.corners) {
        const double height = up.dot(corner);
        lowest = std::min(lowest, height);
        if (up.dot(sole.normal) >= flat) lowest_flat = std::min(lowest_flat, height);
      }
    }
    rest.lifting = lowest_flat - lowest;
    std::vector<Eigen::Vector2d> support;
    for (const Sole& sole : soles) {
      if (up.dot(sole.normal) < flat) continue;
      for (const Eigen::Vector3d& corner : sole.corners) {
        if (up.dot(corner) < lowest_flat + kContactDepth) {
          support.push_back({x.dot(corner), y.dot(corner)});
        }
      }
    }
    const Eigen::Vector2d mass(x.dot(kinematics_.center_of_mass()),
                               y.dot(kinematics_.center_of_mass()));
    support = convex_hull(std::move(support));
    rest.margin = margin_in_polygon(support, mass);
    const Eigen::Vector2d to_edge = nearest_on_edge(support, mass) - mass;
    const double distance = to_edge.norm();
    if (distance > 0) {
      const double sign = rest.margin < 0 ? -1 : 1;
      const Eigen::Vector2d direction = sign / distance * to_edge;
      rest.tipping_direction = direction.x() * x + direction.y() * y;
    }
    if (rest.margin >= 0 || rolled >= kMaxRoll) return rest;
    // Rolling towards a direction turns what was up away from it.
    rest.up_in_torso = (up - kRollStep * rest.tipping_direction).normalized();
  }
}

Eigen::Vector3d TippingGuard::find_standing_up(const std::vector<double>& position,
                                               const Eigen::Vector3d& up_in_torso) {
  kinematics_.update(position);
  std::vector<Eigen::Vector3d> corners;
  for (const Sole& sole : find_soles(kinematics_)) {
    corners.insert(corners.end(), sole.corners.begin(), sole.corners.end());
  }
  // A few corners: every plane through three of them is tried.
  Eigen::Vector3d best = up_in_torso;
  double nearest = std::cos(kUpError);
  for (size_t i = 0; i < corners.size(); ++i) {
    for (size_t j = i + 1; j < corners.size(); ++j) {
      for (size_t k = j + 1; k < corners.size(); ++k) {
        Eigen::Vector3d up = (corners[j] - corners[i]).cross(corners[k] - corners[i]);
        if (up.norm() < kOnLine) continue;
        up.normalize();
        if (up.dot(up_in_torso) < 0) up = -up;
        if (up.dot(up_in_torso) <= nearest + kNoNearer) continue;
        if (!rests_on(up, up.dot(corners[i]), corners, kinematics_.center_of_mass())) continue;
        nearest = up.dot(up_in_torso);
        best = up;
      }
    }
  }
  return best;
}

double TippingGuard::find_safe_share(const std::vector<double>& from, const std::vector<double>& to,
                                     const Eigen::Vector3d& up_in_torso, Rest& tipping) {
  double largest = 0;
  for (size_t i = 0; i < from.size(); ++i) largest = std::max(largest, std::abs(to[i] - from[i]));
  const int num_samples =
      std::clamp(static_cast<int>(std::ceil(largest / kSampleAngle)), 1, kMaxSamples);
  const Eigen::Vector3d standing_up = find_standing_up(from, up_in_torso);
  Eigen::Vector3d up = standing_up;
  // Who stands badly already may move, as long as it does not get worse.
  const Rest start = find_rest(from, up);
  double needed = std::min(kReserve, start.margin);
  const double allowed_lifting = std::max(kLifting, start.lifting + kLifting / 4);
  const double needed_flatness = std::min(std::cos(kFlat), start.flattest - kFlatTolerance);
  std::vector<double> position = from;
  for (int k = 1; k <= num_samples; ++k) {
    const double share = static_cast<double>(k) / num_samples;
    for (size_t i = 0; i < from.size(); ++i) position[i] = from[i] + share * (to[i] - from[i]);
    const Rest rest = find_rest(position, up);
    const bool leans = rest.up_in_torso.dot(standing_up) < std::cos(kMaxRoll);
    if (rest.margin < needed - 1e-9 || rest.flattest < needed_flatness ||
        rest.lifting > allowed_lifting || leans) {
      tipping = rest;
      return static_cast<double>(k - 1) / num_samples;
    }
    needed = std::min(kReserve, std::max(needed, rest.margin));
    up = rest.up_in_torso;
  }
  return 1;
}

}  // namespace nao::motion
