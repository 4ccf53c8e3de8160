#include "robot_import/robot_structure.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>

#include "common/error.h"
#include "kinematics/support_polygon.h"

namespace nao {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

// Two chains are a pair if their ends mirror each other within this fraction of their distance.
constexpr double kPairTolerance = 0.1;
// Joints mirror each other within this fraction of the robot's height, and this angle's sine.
constexpr double kPlaceTolerance = 0.02;
constexpr double kAxisTolerance = 0.05;
// Distance of a foot's points from its lowest one within which they belong to the sole, fraction of
// the leg's height.
constexpr double kSoleDepth = 0.01;
// Sole of a foot without shapes, fractions of the leg's height. Chosen: a NAO's.
constexpr double kSoleLength = 0.45;
constexpr double kSoleWidth = 0.25;

struct Chain {
  int end = -1;
  std::vector<int> joints;
  Vector3d point;
};

// Chains of joints from the root to each link that carries no further joint.
std::vector<Chain> find_chains(const RobotModel& model, const std::vector<Isometry3d>& poses) {
  std::vector<bool> carries_joint(model.links().size(), false);
  for (const Joint& joint : model.joints()) {
    if (joint.kind != Joint::Kind::kRevolute) continue;
    for (int link = joint.parent_link; link >= 0;) {
      carries_joint[link] = true;
      const int parent = model.links()[link].parent_joint;
      link = parent < 0 ? -1 : model.joints()[parent].parent_link;
    }
  }
  std::vector<Chain> chains;
  for (const Joint& joint : model.joints()) {
    if (joint.kind != Joint::Kind::kRevolute || carries_joint[joint.child_link]) continue;
    chains.push_back({joint.child_link, model.find_chain(joint.child_link),
                      poses[joint.child_link].translation()});
  }
  return chains;
}

// Mirror images at the robot's xz plane, the left one first.
bool is_pair(const Chain& left, const Chain& right) {
  const double apart = left.point.y() - right.point.y();
  const Vector3d mirrored(right.point.x(), -right.point.y(), right.point.z());
  return apart > 0 && left.joints.size() == right.joints.size() &&
         (left.point - mirrored).norm() < kPairTolerance * apart;
}

/** Corners of a shape in its link's frame; ends and rims of round ones. */
void add_corners(const Shape& shape, std::vector<Vector3d>& points) {
  Vector3d half = 0.5 * shape.size;
  if (shape.kind == Shape::Kind::kMesh) return;
  if (shape.kind != Shape::Kind::kBox) {
    const double end = shape.kind == Shape::Kind::kCapsule ? shape.radius : 0;
    half = Vector3d(shape.radius, shape.radius, 0.5 * shape.length + end);
    if (shape.kind == Shape::Kind::kSphere) half.z() = shape.radius;
  }
  for (const double x : {-1, 1}) {
    for (const double y : {-1, 1}) {
      for (const double z : {-1, 1}) {
        points.push_back(shape.pose_in_link * half.cwiseProduct(Vector3d(x, y, z)));
      }
    }
  }
}

// Frames without mass that are fixed to a foot and called force sensors; a single one, such as a
// six-axis sensor, does not give a center of pressure.
std::vector<int> find_force_sensors(const RobotModel& model, int foot) {
  std::vector<int> sensors;
  for (int link = 0; link < static_cast<int>(model.links().size()); ++link) {
    if (model.links()[link].mass > 0 || model.find_body(link) != model.find_body(foot)) continue;
    std::string name = model.links()[link].name;
    std::transform(name.begin(), name.end(), name.begin(),
                   [](unsigned char letter) { return std::tolower(letter); });
    const bool is_sensor =
        name.find("fsr") != std::string::npos || name.find("force") != std::string::npos;
    if (is_sensor) sensors.push_back(link);
  }
  if (sensors.size() < 3) sensors.clear();
  return sensors;
}

FoundSole find_sole(const RobotModel& model, const Chain& leg, const std::vector<Isometry3d>& poses,
                    Findings& findings) {
  FoundSole sole;
  sole.foot = leg.end;
  const Isometry3d& foot = poses[leg.end];
  // Height of the leg: from its first joint to its last, m.
  const double height =
      poses[model.joints()[leg.joints.front()].child_link].translation().z() - leg.point.z();
  std::vector<Vector3d> corners;
  for (const Shape& shape : model.links()[leg.end].collisions) add_corners(shape, corners);
  double lowest = std::numeric_limits<double>::infinity();
  // Into the root's frame, with all joints at 0.
  for (Vector3d& corner : corners) {
    corner = foot * corner;
    lowest = std::min(lowest, corner.z());
  }
  const Vector2d ankle = leg.point.head<2>();
  std::vector<Vector2d> points;
  for (const Vector3d& corner : corners) {
    if (corner.z() < lowest + kSoleDepth * height) points.push_back(corner.head<2>() - ankle);
  }
  sole.outline = convex_hull(points);
  // The foot has no shape, or one that touches the ground only along a line.
  if (sole.outline.size() < 3) {
    lowest = leg.point.z() - 0.1 * height;
    const double back = 0.35 * kSoleLength * height;
    const double front = 0.65 * kSoleLength * height;
    const double side = 0.5 * kSoleWidth * height;
    sole.outline = {{-back, -side}, {front, -side}, {front, side}, {-back, side}};
    findings.push_back({Finding::Severity::kMissing, "robot.yaml", 0,
                        "link " + model.links()[leg.end].name,
                        "the foot has no collision shape with a flat lower side",
                        "a rectangle is assumed as its sole: write the outline into `soles`"});
  }
  // The sole's frame: level, under the ankle, with the root's heading.
  Isometry3d pose = Isometry3d::Identity();
  pose.translation() << ankle, lowest;
  sole.pose_in_foot = foot.inverse() * pose;
  sole.sensors = find_force_sensors(model, leg.end);
  return sole;
}

}  // namespace

RobotStructure find_structure(const RobotModel& model, Findings& findings) {
  const auto poses = model.link_poses(std::vector<double>(model.num_motors(), 0.0));
  const std::vector<Chain> chains = find_chains(model, poses);
  const Chain* legs[2] = {nullptr, nullptr};
  // Legs are the lowest pair with at least three joints.
  for (const Chain& left : chains) {
    for (const Chain& right : chains) {
      if (!is_pair(left, right) || left.joints.size() < 3) continue;
      if (legs[0] != nullptr && left.point.z() >= legs[0]->point.z()) continue;
      legs[0] = &left;
      legs[1] = &right;
    }
  }
  // Both chains must end below the root's origin.
  if (legs[0] == nullptr || legs[0]->point.z() >= 0) {
    throw ModelError(
        model.name() +
        ": no two legs: two chains of at least three joints must end below the root, one "
        "at the left (y above 0), the other its mirror image, with x ahead and z up");
  }
  RobotStructure structure;
  for (int side = 0; side < 2; ++side) {
    structure.soles[side] = find_sole(model, *legs[side], poses, findings);
  }
  const Chain* arms[2] = {nullptr, nullptr};
  // Arms are the other pair with the most joints.
  for (const Chain& left : chains) {
    for (const Chain& right : chains) {
      if (!is_pair(left, right) || &left == legs[0] || left.joints.size() < 2) continue;
      if (arms[0] != nullptr && left.joints.size() <= arms[0]->joints.size()) continue;
      arms[0] = &left;
      arms[1] = &right;
    }
  }
  if (arms[0] != nullptr) structure.hands = {arms[0]->end, arms[1]->end};
  return structure;
}

Symmetry find_symmetry(const RobotModel& model) {
  const auto poses = model.link_poses(std::vector<double>(model.num_motors(), 0.0));
  double height = 0;
  for (const Isometry3d& pose : poses) {
    height = std::max(height, std::abs(pose.translation().z()));
  }
  const auto place = [&](int motor) -> Vector3d {
    return poses[model.motor_joint(motor).child_link].translation();
  };
  const auto axis = [&](int motor) -> Vector3d {
    const Joint& joint = model.motor_joint(motor);
    return poses[joint.child_link].linear() * joint.axis;
  };
  Symmetry symmetry;
  for (int motor = 0; motor < model.num_motors(); ++motor) symmetry.mirrors.push_back({motor, 1});
  for (int motor = 0; motor < model.num_motors(); ++motor) {
    // Each motor's mirror image: the joint whose place and axis are nearest to the reflected ones.
    const Vector3d point = place(motor).cwiseProduct(Vector3d(1, -1, 1));
    // An angular velocity is a pseudovector: its reflection keeps y and reverses x and z.
    const Vector3d image = axis(motor).cwiseProduct(Vector3d(-1, 1, -1));
    int best = -1;
    double nearest = kPlaceTolerance * height;
    for (int other = 0; other < model.num_motors(); ++other) {
      if (image.cross(axis(other)).norm() > kAxisTolerance) continue;
      const double distance = (place(other) - point).norm();
      if (distance >= nearest) continue;
      nearest = distance;
      best = other;
    }
    if (best < 0) continue;
    // The sign is that of the mirrored motion's angle relative to the original's.
    symmetry.mirrors[motor] = {best, image.dot(axis(best)) > 0 ? 1.0 : -1.0};
  }
  // Pairs must be mutual.
  for (int motor = 0; motor < model.num_motors(); ++motor) {
    const MirrorMotor mirror = symmetry.mirrors[motor];
    if (symmetry.mirrors[mirror.motor].motor != motor) symmetry.mirrors[motor] = {motor, 1};
  }
  for (int motor = 0; motor < model.num_motors(); ++motor) {
    const int other = symmetry.mirrors[motor].motor;
    const std::string& name = model.motor_joint(motor).name;
    if (other == motor) {
      symmetry.pairs.push_back({name, motor, -1});
    } else if (place(motor).y() > place(other).y()) {
      // A star marks the names of pairs, which are not joint names.
      symmetry.pairs.push_back({name + "*", motor, other});
    }
  }
  return symmetry;
}

}  // namespace nao
