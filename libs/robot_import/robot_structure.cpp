#include "robot_import/robot_structure.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <sstream>

#include "kinematics/support_polygon.h"

namespace nao {
namespace {

using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

// Two chains are a pair if their ends mirror each other within this fraction of their distance.
constexpr double kPairTolerance = 0.1;
// Joints mirror each other within this fraction of the robot's height, and this angle's sine.
constexpr double kPlaceTolerance = 0.02;
constexpr double kAxisTolerance = 0.05;
// The same along the axes of two joints.
constexpr double kSlideTolerance = 0.2;
// Distance of a foot's points from its lowest one within which they belong to the sole, fraction of
// the leg's height. Chosen: the height of cleats.
constexpr double kSoleDepth = 0.03;
// Angles, rad, by which a foot may be off the level at the angles 0.
constexpr double kGreatestTilt = 0.6;
constexpr double kTiltStep = 0.02;
// Sole of a foot without shapes, fractions of the leg's height. Chosen: a NAO's.
constexpr double kSoleLength = 0.45;
constexpr double kSoleWidth = 0.25;
// Its greatest width, fraction of the distance of the feet.
constexpr double kSoleWidthOfStance = 0.7;
// Length of a foot that is a point, fraction of the leg's height.
constexpr double kPointLength = 0.12;
// Least distance of a sole's frame from its heel and toe, fraction of the sole's length.
constexpr double kLeastHeel = 0.15;
// A corner of an outline nearer to the line of its neighbors is left out, fraction of the outline's
// width.
constexpr double kLeastBend = 0.03;
// Mass of each half of the plate that holds a robot without legs, fraction of the robot's.
constexpr double kBaseMass = 5;
// Legs along another axis than z weigh more by this factor. Chosen: arms weigh less than legs.
constexpr double kClearlyGreater = 1.5;
// The origin of the root's frame may be off the plane of symmetry by as much, m.
constexpr double kPlaneTolerance = 1e-3;

struct Chain {
  int end = -1;
  std::vector<int> joints;
  Vector3d point;
};

/** A robot at the angle 0 of all joints, in a frame that may become its own. */
struct Body {
  const RobotModel& model;
  std::vector<Isometry3d> poses;
  /** Corners of each link's surface, in that frame, m. */
  std::vector<std::vector<Vector3d>> points;

  /** Of a link's surface, or of its center of mass; infinity for a frame, which is nowhere. */
  double lowest(int link) const {
    double z = std::numeric_limits<double>::infinity();
    for (const Vector3d& point : points[link]) z = std::min(z, point.z());
    const Link& part = model.links()[link];
    return points[link].empty() && part.mass > 0 ? (poses[link] * part.center_of_mass).z() : z;
  }
};

// Chains of joints from the root to each link that carries no further joint.
std::vector<Chain> find_chains(const Body& body) {
  const RobotModel& model = body.model;
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
    // Any point of its axis may be the joint's origin: of a roll axis the one beside the joint
    // above is taken, which is the ankle's, of others the one beside the link's center of mass.
    const Isometry3d& pose = body.poses[joint.child_link];
    const Vector3d axis = pose.linear() * joint.axis;
    Vector3d beside = pose * model.links()[joint.child_link].center_of_mass;
    const std::vector<int> joints = model.find_chain(joint.child_link);
    if (std::abs(axis.x()) > 0.5 && joints.size() > 1) {
      const Joint& above = model.joints()[joints[joints.size() - 2]];
      beside = body.poses[above.child_link].translation();
    }
    const Vector3d point = pose.translation() + axis.dot(beside - pose.translation()) * axis;
    chains.push_back({joint.child_link, joints, point});
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

Body make_body(const RobotModel& model, const MeshPoints& mesh_points, const Isometry3d& frame) {
  Body body{model, model.link_poses(std::vector<double>(model.num_motors(), 0.0)), {}};
  for (size_t link = 0; link < model.links().size(); ++link) {
    Isometry3d& pose = body.poses[link];
    pose = frame.inverse() * pose;
    const Link& part = model.links()[link];
    std::vector<Vector3d> points;
    for (int shape = -1; shape < static_cast<int>(part.collisions.size()); ++shape) {
      // A mesh itself instead of the shape about it.
      const auto mesh = mesh_points.find({part.name, shape});
      if (mesh != mesh_points.end()) {
        points.insert(points.end(), mesh->second.begin(), mesh->second.end());
      } else if (shape >= 0) {
        add_corners(part.collisions[shape], points);
      }
    }
    for (Vector3d& point : points) point = pose * point;
    body.points.push_back(std::move(points));
  }
  return body;
}

double area_of(const std::vector<Vector2d>& outline) {
  double twice = 0;
  for (size_t i = 0; i < outline.size(); ++i) {
    const Vector2d& next = outline[(i + 1) % outline.size()];
    twice += outline[i].x() * next.y() - outline[i].y() * next.x();
  }
  return 0.5 * twice;
}

/** Convex outline of the points near the lowest one. @param lowest  Receives its height. */
std::vector<Vector2d> find_outline(const std::vector<Vector3d>& points, const Matrix3d& level,
                                   double depth, double& lowest) {
  lowest = std::numeric_limits<double>::infinity();
  const Vector3d up = level.row(2);
  for (const Vector3d& point : points) lowest = std::min(lowest, up.dot(point));
  std::vector<Vector2d> near;
  for (const Vector3d& point : points) {
    if (up.dot(point) < lowest + depth) near.push_back((level * point).head<2>());
  }
  return convex_hull(near);
}

/** Leaves out corners that change the outline little, such as those in one line. */
void simplify(std::vector<Vector2d>& outline) {
  Eigen::AlignedBox2d box;
  for (const Vector2d& corner : outline) box.extend(corner);
  for (size_t i = 0; i < outline.size() && outline.size() > 3;) {
    const Vector2d& a = outline[(i + outline.size() - 1) % outline.size()];
    const Vector2d along = outline[(i + 1) % outline.size()] - a;
    const Vector2d to = outline[i] - a;
    const double bend = std::abs(along.x() * to.y() - along.y() * to.x()) / along.norm();
    if (bend < kLeastBend * box.sizes().minCoeff()) {
      outline.erase(outline.begin() + static_cast<long>(i));
      i = 0;
    } else {
      ++i;
    }
  }
}

/** Fewer joints pitch the leg than hip, knee and ankle have. */
bool lacks_ankle_pitch(const Body& body, const Chain& leg) {
  return std::count_if(leg.joints.begin(), leg.joints.end(), [&](int index) {
           const Joint& joint = body.model.joints()[index];
           return std::abs((body.poses[joint.child_link].linear() * joint.axis).y()) > 0.7;
         }) < 3;
}

std::vector<Vector2d> make_rectangle(double back, double front, double side) {
  return {{-back, -side}, {front, -side}, {front, side}, {-back, side}};
}

FoundSole find_sole(const Body& body, const Chain& leg) {
  const RobotModel& model = body.model;
  FoundSole sole;
  sole.foot = leg.end;
  // Height of the leg: from its first joint to its last, m.
  const double height =
      body.poses[model.joints()[leg.joints.front()].child_link].translation().z() - leg.point.z();
  std::vector<Vector3d> points;
  for (size_t link = 0; link < model.links().size(); ++link) {
    if (model.find_body(static_cast<int>(link)) != model.find_body(leg.end)) continue;
    for (const Vector3d& point : body.points[link]) points.push_back(point - leg.point);
  }
  // The foot stands on the surface that is level at the angles 0, or on a larger one near it.
  Matrix3d level = Matrix3d::Identity();
  double lowest = 0;
  sole.outline = find_outline(points, level, kSoleDepth * height, lowest);
  Eigen::AlignedBox2d extent;
  for (const Vector2d& corner : sole.outline) extent.extend(corner);
  sole.is_point =
      !points.empty() && lacks_ankle_pitch(body, leg) && extent.sizes().x() < kPointLength * height;
  double largest = 2 * area_of(sole.outline);
  const bool is_searched = !points.empty() && !sole.is_point;
  for (double tilt = -kGreatestTilt; is_searched && tilt <= kGreatestTilt; tilt += kTiltStep) {
    for (int axis = 0; axis < 2; ++axis) {
      const Matrix3d turn = Eigen::AngleAxisd(tilt, Vector3d::Unit(axis)).toRotationMatrix();
      double at = 0;
      const auto outline = find_outline(points, turn, 0.3 * kSoleDepth * height, at);
      if (area_of(outline) <= largest) continue;
      largest = area_of(outline);
      level = turn;
      lowest = at;
      sole.outline = outline;
    }
  }
  simplify(sole.outline);
  sole.has_shape = !points.empty() && !sole.is_point;
  if (sole.is_point) {
    const double half = 0.5 * kSoleLength * height;
    sole.outline = make_rectangle(half, half, 0.5 * kSoleWidth * height);
  }
  // The foot has no shape, or one that touches the ground only along a line.
  if (sole.outline.size() < 3 ||
      area_of(sole.outline) < 1e-3 * kSoleLength * kSoleWidth * height * height) {
    sole.outline.clear();
    lowest = points.empty() ? -0.1 * height : lowest;
  }
  // The sole's frame: level, under the ankle, with the robot's heading; within the sole where the
  // ankle is not above it.
  double ahead = 0;
  if (!sole.outline.empty()) {
    Eigen::AlignedBox2d box;
    for (const Vector2d& corner : sole.outline) box.extend(corner);
    const double margin = kLeastHeel * box.sizes().x();
    ahead = std::clamp(0.0, box.min().x() + margin, box.max().x() - margin);
  }
  for (Vector2d& corner : sole.outline) corner.x() -= ahead;
  Isometry3d pose = Isometry3d::Identity();
  pose.linear() = level.transpose();
  pose.translation() = leg.point + level.transpose() * Vector3d(ahead, 0, lowest);
  sole.pose_in_foot = body.poses[leg.end].inverse() * pose;
  sole.sensors = find_force_sensors(model, leg.end);
  return sole;
}

/** One outline for both feet, of which the larger one is taken: a foot may lack shapes that the
 * other has. */
void make_alike(std::array<FoundSole, 2>& soles, const Body& body, double height,
                Findings& findings) {
  const std::array<double, 2> area = {area_of(soles[0].outline), area_of(soles[1].outline)};
  if (area[0] <= 0 && area[1] <= 0) {
    // Feet that touch never stand side by side.
    const auto y = [&](const FoundSole& sole) {
      return (body.poses[sole.foot] * sole.pose_in_foot.translation()).y();
    };
    const double side =
        std::min(0.5 * kSoleWidth * height, kSoleWidthOfStance * 0.5 * (y(soles[0]) - y(soles[1])));
    for (FoundSole& sole : soles) {
      sole.outline = make_rectangle(0.35 * kSoleLength * height, 0.65 * kSoleLength * height, side);
      findings.push_back({Finding::Severity::kMissing, "robot.yaml", 0,
                          "link " + body.model.links()[sole.foot].name,
                          "the foot has no collision shape with a flat lower side",
                          "a rectangle is assumed as its sole: write the outline into `soles`"});
    }
    return;
  }
  const int better = area[1] > 1.02 * area[0] ? 1 : 0;
  const FoundSole& from = soles[better];
  FoundSole& to = soles[1 - better];
  if (std::abs(area[0] - area[1]) > 0.1 * area[better]) {
    findings.push_back(
        {Finding::Severity::kRepaired, "robot.yaml", 0, "link " + body.model.links()[to.foot].name,
         "its sole is unlike that of the other foot",
         "the other one's mirror image is assumed: compare the outlines in `soles`"});
  }
  to.outline.assign(from.outline.rbegin(), from.outline.rend());
  for (Vector2d& corner : to.outline) corner.y() = -corner.y();
}

using Legs = std::array<const Chain*, 2>;

/** Mass and center of mass of the links that none of two chains moves. */
double find_rest(const Body& body, const Legs& legs, Vector3d& com) {
  double mass = 0;
  com.setZero();
  for (size_t link = 0; link < body.model.links().size(); ++link) {
    const Link& part = body.model.links()[link];
    const bool is_leg = std::any_of(legs.begin(), legs.end(), [&](const Chain* leg) {
      return body.model.moves(leg->joints.front(), static_cast<int>(link));
    });
    if (is_leg) continue;
    mass += part.mass;
    com += part.mass * (body.poses[link] * part.center_of_mass);
  }
  if (mass > 0) com /= mass;
  return mass;
}

/** Whether two chains can carry the robot. */
bool are_legs(const Body& body, const Legs& legs) {
  const int hip = body.model.joints()[legs[0]->joints.front()].child_link;
  const double top = body.poses[hip].translation().z();
  const double drop = top - legs[0]->point.z();
  // They hang, and the rest stands above them.
  if (drop < 0.5 * (body.poses[hip].translation() - legs[0]->point).norm()) return false;
  Vector3d com;
  if (find_rest(body, legs, com) > 0 && com.z() < top - 0.1 * drop) return false;
  // They reach lower than everything else.
  double sole = legs[0]->point.z();
  double rest = sole;
  for (size_t link = 0; link < body.model.links().size(); ++link) {
    const bool is_leg = std::any_of(legs.begin(), legs.end(), [&](const Chain* leg) {
      return body.model.moves(leg->joints.front(), static_cast<int>(link));
    });
    double& lowest = is_leg ? sole : rest;
    lowest = std::min(lowest, body.lowest(static_cast<int>(link)));
  }
  return rest >= sole - 0.02 * drop;
}

/** Without the joints that both chains share. */
std::array<Chain, 2> own_parts(const Chain& left, const Chain& right) {
  std::array<Chain, 2> own = {left, right};
  size_t shared = 0;
  while (shared < std::min(left.joints.size(), right.joints.size()) &&
         left.joints[shared] == right.joints[shared]) {
    ++shared;
  }
  for (Chain& chain : own) {
    chain.joints.erase(chain.joints.begin(), chain.joints.begin() + static_cast<long>(shared));
  }
  return own;
}

/** Legs are the lowest pair with at least three joints each; nothing if none can carry the robot.
 */
std::vector<Chain> find_legs(const Body& body, const std::vector<Chain>& chains) {
  std::vector<Chain> legs;
  double lowest = std::numeric_limits<double>::infinity();
  for (const Chain& left : chains) {
    for (const Chain& right : chains) {
      if (!is_pair(left, right)) continue;
      const std::array<Chain, 2> own = own_parts(left, right);
      if (own[0].joints.size() < 3 || !are_legs(body, {&own[0], &own[1]})) continue;
      const double z = std::min(left.point.z(), body.lowest(left.end));
      if (z >= lowest) continue;
      lowest = z;
      legs = {own[0], own[1]};
    }
  }
  return legs;
}

/** The vertical plane, of normal x or y of the frame, that mirrors most joints onto others.
 * @param offset  Receives its place along the normal, m. @return 0 or 1: x or y; -1: none. */
int find_plane(const Body& body, double& offset) {
  struct Screw {
    Vector3d point;
    Vector3d axis;
  };
  std::vector<Screw> screws;
  double size = 0;
  for (const Joint& joint : body.model.joints()) {
    if (joint.kind != Joint::Kind::kRevolute) continue;
    const Isometry3d& pose = body.poses[joint.child_link];
    screws.push_back({pose.translation(), pose.linear() * joint.axis});
    for (const Screw& screw : screws)
      size = std::max(size, (screw.point - pose.translation()).norm());
  }
  const double tolerance = kPlaceTolerance * size;
  const auto is_image = [&](const Screw& a, const Screw& b, int normal, double at) {
    Vector3d point = a.point;
    point[normal] = 2 * at - point[normal];
    Vector3d axis = -a.axis;
    axis[normal] = a.axis[normal];
    // Any point of an axis may be the joint's origin.
    return (point - b.point).cross(b.axis).norm() < tolerance &&
           axis.cross(b.axis).norm() < kAxisTolerance;
  };
  int best = -1;
  size_t most = 0;
  for (int normal = 1; normal >= 0; --normal) {
    for (size_t i = 0; i < screws.size(); ++i) {
      for (size_t k = i + 1; k < screws.size(); ++k) {
        // Joints on the plane are their own images.
        if (std::abs(screws[i].point[normal] - screws[k].point[normal]) < 2 * tolerance) continue;
        const double at = 0.5 * (screws[i].point[normal] + screws[k].point[normal]);
        if (!is_image(screws[i], screws[k], normal, at)) continue;
        size_t count = 0;
        // Axes along the normal do not say where the plane is.
        size_t across = 0;
        double sum = 0;
        for (size_t a = 0; a < screws.size(); ++a) {
          for (size_t b = a + 1; b < screws.size(); ++b) {
            if (std::abs(screws[a].point[normal] - screws[b].point[normal]) < 2 * tolerance ||
                !is_image(screws[a], screws[b], normal, at)) {
              continue;
            }
            ++count;
            if (std::abs(screws[a].axis[normal]) > 0.7) continue;
            ++across;
            sum += 0.5 * (screws[a].point[normal] + screws[b].point[normal]);
          }
        }
        if (count <= most) continue;
        most = count;
        best = normal;
        offset = across > 0 ? sum / static_cast<double>(across) : at;
      }
    }
  }
  return best;
}

/** Above 0 where the legs point along x of the frame, by their feet and knees; about -1.5 to 1.5.
 */
double find_heading(const Body& body, const std::vector<Chain>& legs) {
  double heading = 0;
  for (const Chain& leg : legs) {
    // The foot's surface is longer ahead of the ankle than behind it.
    double front = 0;
    double back = 0;
    for (size_t link = 0; link < body.model.links().size(); ++link) {
      if (body.model.find_body(static_cast<int>(link)) != body.model.find_body(leg.end)) continue;
      for (const Vector3d& point : body.points[link]) {
        front = std::max(front, point.x() - leg.point.x());
        back = std::max(back, leg.point.x() - point.x());
      }
    }
    if (front + back > 0) heading += 0.5 * (front - back) / (front + back);
    // The joint with the largest one-sided range about y is the knee: it takes the foot back.
    double knee = 0;
    for (const int index : leg.joints) {
      const Joint& joint = body.model.joints()[index];
      const double pitch = (body.poses[joint.child_link].linear() * joint.axis).y();
      const double sided = (joint.upper + joint.lower) * pitch;
      const double drop = body.poses[joint.child_link].translation().z() - leg.point.z();
      if (drop > 0.05 && std::abs(pitch) > 0.7 && std::abs(sided) > std::abs(knee)) knee = sided;
    }
    heading += 0.25 * std::clamp(knee, -1.0, 1.0);
  }
  return heading;
}

/** The frame in which two legs were found, and the legs. */
struct FoundFrame {
  Isometry3d frame = Isometry3d::Identity();
  std::vector<Chain> legs;
};

/** Whether there is a pair of limbs besides the legs. */
bool has_arms(const std::vector<Chain>& chains, const std::vector<Chain>& legs) {
  for (const Chain& left : chains) {
    const auto& joints = left.joints;
    if (std::find(joints.begin(), joints.end(), legs[0].joints.front()) != joints.end()) continue;
    for (const Chain& right : chains) {
      if (is_pair(left, right) && own_parts(left, right)[0].joints.size() >= 2) return true;
    }
  }
  return false;
}

/** Length of two legs, m, by their mass, kg: of limbs that hang the legs are longer and heavier. */
double weigh_legs(const Body& body, const std::vector<Chain>& legs) {
  double mass = 0;
  for (size_t link = 0; link < body.model.links().size(); ++link) {
    const bool is_leg = body.model.moves(legs[0].joints.front(), static_cast<int>(link));
    mass += is_leg ? body.model.links()[link].mass : 0;
  }
  const int hip = body.model.joints()[legs[0].joints.front()].child_link;
  return mass * (body.poses[hip].translation().z() - legs[0].point.z());
}

// The root's z axis is up in most files; otherwise another axis, along which clearly greater legs
// hang: of a robot that has arms, too, for these hang or point somewhere as well.
FoundFrame find_frame(const RobotModel& model, const MeshPoints& mesh_points) {
  const Vector3d x = Vector3d::UnitX();
  const Vector3d y = Vector3d::UnitY();
  const Vector3d z = Vector3d::UnitZ();
  FoundFrame best;
  double greatest = 0;
  for (const Vector3d& up : {z, y, x, Vector3d(-y), Vector3d(-x), Vector3d(-z)}) {
    Isometry3d frame = Isometry3d::Identity();
    if (up != z) {
      frame.linear().col(2) = up;
      frame.linear().col(0) = std::abs(up.x()) > 0.5 ? y : x;
      frame.linear().col(1) = up.cross(Vector3d(frame.linear().col(0)));
    }
    double offset = 0;
    const int normal = find_plane(make_body(model, {}, frame), offset);
    if (normal < 0) continue;
    // Turned so that the plane's normal is y.
    if (std::abs(offset) > kPlaneTolerance) {
      frame.translation() = offset * frame.linear().col(normal);
    }
    if (normal == 0) frame.rotate(Eigen::AngleAxisd(M_PI / 2, z));
    const Body body = make_body(model, mesh_points, frame);
    const std::vector<Chain> chains = find_chains(body);
    FoundFrame found{frame, find_legs(body, chains)};
    if (found.legs.empty() || (up != z && !has_arms(chains, found.legs))) continue;
    const double weight = weigh_legs(body, found.legs);
    if (weight <= greatest) continue;
    greatest = (up == z ? kClearlyGreater : 1) * weight;
    // Against x of the root only on clear evidence.
    if (find_heading(body, found.legs) < (up == z && normal == 1 ? -0.3 : 0)) {
      found.frame.rotate(Eigen::AngleAxisd(M_PI, z));
      const Body turned = make_body(model, mesh_points, found.frame);
      found.legs = find_legs(turned, find_chains(turned));
    }
    best = std::move(found);
  }
  return best;
}

std::array<FoundSole, 2> find_feet(const Body& body, const std::vector<Chain>& legs,
                                   Findings& findings) {
  std::array<FoundSole, 2> soles = {find_sole(body, legs[0]), find_sole(body, legs[1])};
  const int hip = body.model.joints()[legs[0].joints.front()].child_link;
  const double height = body.poses[hip].translation().z() - legs[0].point.z();
  make_alike(soles, body, height, findings);
  for (const FoundSole& sole : soles) {
    if (!sole.is_point) continue;
    std::ostringstream text;
    text << "it stands on plates of " << kSoleLength * height << " x " << kSoleWidth * height
         << " m that are assumed below them";
    findings.push_back({Finding::Severity::kMissing, "robot.yaml", 0,
                        "link " + body.model.links()[sole.foot].name,
                        "the feet are points that no joint pitches, on which only steps keep the "
                        "balance",
                        text.str()});
  }
  return soles;
}

/** Both halves of a plate below a robot without legs. */
std::array<FoundSole, 2> make_base(const Body& body, Findings& findings) {
  Eigen::AlignedBox3d box;
  for (size_t link = 0; link < body.model.links().size(); ++link) {
    box.extend(Vector3d(body.poses[link].translation()));
    for (const Vector3d& point : body.points[link]) box.extend(point);
  }
  const double side = std::max(0.1, box.diagonal().norm());
  std::array<FoundSole, 2> soles;
  for (int i = 0; i < 2; ++i) {
    FoundSole& sole = soles[i];
    Isometry3d pose = Isometry3d::Identity();
    // Arms that hang must not reach the floor.
    pose.translation() << 0, (i == 0 ? 0.26 : -0.26) * side, box.min().z() - 0.3 * side;
    sole.foot = 0;
    sole.pose_in_foot = body.poses[0].inverse() * pose;
    sole.outline = {{-0.5 * side, -0.25 * side},
                    {0.5 * side, -0.25 * side},
                    {0.5 * side, 0.25 * side},
                    {-0.5 * side, 0.25 * side}};
    sole.has_shape = false;
    sole.plate_mass = kBaseMass * body.model.total_mass();
  }
  std::ostringstream text;
  text << "it stands on an added plate of " << side << " m and "
       << 2 * kBaseMass * body.model.total_mass()
       << " kg, as if it were fixed to the floor, and cannot walk";
  findings.push_back({Finding::Severity::kMissing, "robot.yaml", 0,
                      "link " + body.model.links().front().name,
                      "no two legs: no two chains of three or more joints that mirror each other "
                      "reach lower than all other parts",
                      text.str()});
  return soles;
}

}  // namespace

RobotStructure find_structure(const RobotModel& model, const MeshPoints& mesh_points,
                              Findings& findings) {
  const FoundFrame found = find_frame(model, mesh_points);
  const std::vector<Chain>& legs = found.legs;
  RobotStructure structure;
  // Without rounding, which a rotation by quarters of a turn leaves.
  structure.frame = found.frame;
  structure.frame.linear() = found.frame.linear().array().round();
  const Body body = make_body(model, mesh_points, structure.frame);
  if (!structure.frame.matrix().isIdentity(0)) {
    std::ostringstream text;
    text << "the root's frame is not that of the robot: ahead is ("
         << structure.frame.linear().col(0).transpose() << "), up is ("
         << structure.frame.linear().col(2).transpose() << "), its plane of symmetry is "
         << structure.frame.translation().norm() << " m from the origin";
    findings.push_back({Finding::Severity::kRepaired, "robot.yaml", 0,
                        "link " + model.links().front().name, text.str(),
                        "a new root with the robot's frame is added"});
  }
  if (legs.empty()) {
    structure.soles = make_base(body, findings);
  } else {
    structure.soles = find_feet(body, legs, findings);
  }
  const std::vector<Chain> chains = find_chains(body);
  const Chain* arms[2] = {nullptr, nullptr};
  // Arms are the other pair with the most joints.
  for (const Chain& left : chains) {
    for (const Chain& right : chains) {
      if (!is_pair(left, right) || left.joints.size() < 2) continue;
      // Toes belong to a leg.
      const auto& joints = left.joints;
      if (!legs.empty() &&
          std::find(joints.begin(), joints.end(), legs[0].joints.front()) != joints.end()) {
        continue;
      }
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
    // Each motor's mirror image: the joint whose axis is the reflected one, and of these the one
    // whose place, which may be any point of its axis, is nearest.
    const Vector3d point = place(motor).cwiseProduct(Vector3d(1, -1, 1));
    // An angular velocity is a pseudovector: its reflection keeps y and reverses x and z.
    const Vector3d image = axis(motor).cwiseProduct(Vector3d(-1, 1, -1));
    int best = -1;
    double nearest = kSlideTolerance * height;
    for (int other = 0; other < model.num_motors(); ++other) {
      if (image.cross(axis(other)).norm() > kAxisTolerance) continue;
      const Vector3d off = place(other) - point;
      const double distance = off.norm();
      if (off.cross(axis(other)).norm() > kPlaceTolerance * height || distance >= nearest) continue;
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
