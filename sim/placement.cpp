#include "sim/placement.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "common/rotation.h"

namespace nao::sim {
namespace {

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

/** A rigid body rests on a floor where the height of its center of mass over its lowest point has a
 * minimum (least potential energy): found by trying all pitch angles. */
Quaterniond sitting_orientation(const RobotModel& model, const Tree& tree,
                                const CollisionModel& collisions, const Posture& posture) {
  // Range and resolution of the search, rad: chosen, a seat leans by less than 45 degrees, and the
  // robot settles by the rest itself.
  constexpr double kMaxPitch = 0.8;
  constexpr double kPitchStep = 0.005;
  std::vector<Vector3d> points;
  std::vector<double> radii;
  // Contact points in the torso's frame, and their radii; only orientation changes in the search.
  const std::vector<Eigen::Isometry3d> poses = model.link_poses(posture.position);
  for (const CollisionModel::Part& part : collisions.parts) {
    const int joint = tree.bodies()[part.body].joint;
    // A body's frame is that of the link that its joint moves; the root's is link 0.
    const int body_link = joint < 0 ? 0 : model.joints()[joint].child_link;
    for (int i = part.first_point; i < part.end_point; ++i) {
      points.push_back(poses[body_link] * collisions.points[i].center_in_body);
      radii.push_back(collisions.points[i].radius);
    }
  }
  // Center of mass in the torso's frame, by mass-weighted mean.
  Vector3d com = Vector3d::Zero();
  for (size_t i = 0; i < poses.size(); ++i) {
    com += model.links()[i].mass * (poses[i] * model.links()[i].center_of_mass);
  }
  com /= model.total_mass();
  Quaterniond best = Quaterniond::Identity();
  double least = std::numeric_limits<double>::infinity();
  for (double pitch = -kMaxPitch; pitch <= kMaxPitch; pitch += kPitchStep) {
    const Quaterniond orientation(Eigen::AngleAxisd(pitch, Vector3d::UnitY()));
    double lowest = std::numeric_limits<double>::infinity();
    for (size_t i = 0; i < points.size(); ++i) {
      lowest = std::min(lowest, (orientation * points[i]).z() - radii[i]);
    }
    // Height of the center of mass over the floor when the lowest point touches it.
    const double height = (orientation * com).z() - lowest;
    if (height >= least) continue;
    least = height;
    best = orientation;
  }
  return best;
}

}  // namespace

// Orientation of the torso in W at which a posture of this family rests on the floor. Families are
// robot.yaml's words.
Quaterniond resting_orientation(const RobotModel& model, const Tree& tree,
                                const CollisionModel& collisions, const Posture* posture) {
  if (posture == nullptr) return Quaterniond::Identity();
  if (posture->family == "lying-back") {
    return Quaterniond(Eigen::AngleAxisd(-M_PI / 2, Vector3d::UnitY()));
  }
  if (posture->family == "lying-belly") {
    return Quaterniond(Eigen::AngleAxisd(M_PI / 2, Vector3d::UnitY()));
  }
  if (posture->family == "sitting") return sitting_orientation(model, tree, collisions, *posture);
  if (model.left_sole() < 0) return Quaterniond::Identity();
  // The torso leans so that the left sole is level.
  const Matrix3d sole = model.link_poses(posture->position)[model.left_sole()].linear();
  const Vector3d up_in_torso = sole.col(2);
  // The shortest rotation that makes the sole's normal vertical; heading stays as near to 0 as that
  // allows.
  return rotation_between(up_in_torso, Vector3d::UnitZ());
}

double lowest_point(const CollisionModel& collisions, const TreeDynamics& dynamics,
                    const Floor& floor) {
  double lowest = std::numeric_limits<double>::infinity();
  for (const CollisionModel::Part& part : collisions.parts) {
    for (int i = part.first_point; i < part.end_point; ++i) {
      const CollisionModel::Point& point = collisions.points[i];
      const Vector3d in_world =
          dynamics.position(part.body) + dynamics.rotation(part.body) * point.center_in_body;
      // Each point is compared with the floor below it: on bumps the lowest point is not always the
      // one that touches.
      const double ground = floor.is_flat() ? 0 : floor.at(in_world.x(), in_world.y()).height;
      lowest = std::min(lowest, in_world.z() - point.radius - ground);
    }
  }
  return std::isfinite(lowest) ? lowest : 0;
}

}  // namespace nao::sim
