#include "sim/collision_model.h"

#include <algorithm>
#include <set>

#include "robot_model/collision_shape.h"

namespace nao::sim {
namespace {

using Eigen::Vector3d;

/** Radius of a box's rounded edges, m: about that of the NAO's shells (chosen). Two boxes may
 * overlap by twice as much before their inner boxes meet, see RoundedBox. */
constexpr double kEdgeRadius = 0.008;

// A link's collision shape as a box with rounded edges, in the frame of the tree body that carries
// the link (links behind fixed joints share one body).
CollisionModel::Part part_of(const Shape& shape, const Link& link,
                             const Eigen::Isometry3d& link_in_body) {
  const RoundedBox box = rounded_box_in_link(link, shape, kEdgeRadius);
  CollisionModel::Part part;
  part.center_in_body = link_in_body * box.center;
  part.rotation_in_body = link_in_body.linear() * box.rotation;
  part.half = box.half;
  part.radius = box.radius;
  part.bounding_radius = part.half.norm() + part.radius;
  return part;
}

// Twice the area of the triangle a, b, c, m^2: the 2D cross product of two of its sides.
double twice_area(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  const Eigen::Vector2d u = b - a;
  const Eigen::Vector2d v = c - a;
  return std::abs(u.x() * v.y() - u.y() * v.x());
}

/** Distinct corners of a part's inner box in its body's frame: 1 (sphere), 2 (capsule) or 8. */
std::vector<Vector3d> corners_of(const CollisionModel::Part& part) {
  // A half length of 0 makes corners coincide: the set keeps one of each. The coordinates are equal
  // bit by bit then, since the same numbers are added.
  std::set<std::vector<double>> distinct;
  std::vector<Vector3d> corners;
  for (int i = 0; i < 8; ++i) {
    const Vector3d local((i & 1 ? 1 : -1) * part.half.x(), (i & 2 ? 1 : -1) * part.half.y(),
                         (i & 4 ? 1 : -1) * part.half.z());
    const Vector3d corner = part.center_in_body + part.rotation_in_body * local;
    if (distinct.insert({corner.x(), corner.y(), corner.z()}).second) corners.push_back(corner);
  }
  return corners;
}

}  // namespace

std::vector<Eigen::Vector2d> simplify_outline(std::vector<Eigen::Vector2d> outline, int count) {
  // Visvalingam's simplification: the corner whose triangle with its two neighbors is smallest
  // changes the outline's area least, and is removed first.
  while (static_cast<int>(outline.size()) > count) {
    const size_t n = outline.size();
    size_t least = 0;
    double least_area = -1;
    for (size_t i = 0; i < n; ++i) {
      const double area = twice_area(outline[(i + n - 1) % n], outline[i], outline[(i + 1) % n]);
      if (least_area >= 0 && area >= least_area) continue;
      least_area = area;
      least = i;
    }
    outline.erase(outline.begin() + static_cast<long>(least));
  }
  return outline;
}

namespace {

/** Every third corner, in three turns. Contacts beside each other depend on each other most: the
 * solver needs a tenth fewer iterations if it does not visit them in a row (measured, walking). */
std::vector<Eigen::Vector2d> spread(const std::vector<Eigen::Vector2d>& outline) {
  constexpr size_t kStride = 3;
  std::vector<Eigen::Vector2d> result;
  for (size_t first = 0; first < kStride; ++first) {
    for (size_t i = first; i < outline.size(); i += kStride) result.push_back(outline[i]);
  }
  return result;
}

}  // namespace

std::vector<Eigen::Vector2d> inner_points(const std::vector<Eigen::Vector2d>& outline,
                                          double spacing) {
  // Fewer than three corners enclose no area.
  std::vector<Eigen::Vector2d> points;
  if (outline.size() < 3) return points;
  // Bounding box, and twice the signed area by the shoelace formula: positive for a
  // counterclockwise outline.
  Eigen::Vector2d low = outline[0];
  Eigen::Vector2d high = outline[0];
  double area = 0;
  for (size_t i = 0; i < outline.size(); ++i) {
    const Eigen::Vector2d& a = outline[i];
    const Eigen::Vector2d& b = outline[(i + 1) % outline.size()];
    low = low.cwiseMin(a);
    high = high.cwiseMax(a);
    area += a.x() * b.y() - a.y() * b.x();
  }
  // With the outline's sense of rotation, "inside" is the left side of every edge below. That holds
  // for convex outlines only, which soles are.
  const double turn = area > 0 ? 1 : -1;
  const Eigen::Vector2d center = (low + high) / 2;
  const Eigen::Vector2i count = ((high - low) / (2 * spacing)).array().floor().cast<int>();
  // A grid about the center of the bounding box, so that the points of a symmetric sole are
  // symmetric.
  for (int i = -count.x(); i <= count.x(); ++i) {
    for (int k = -count.y(); k <= count.y(); ++k) {
      const Eigen::Vector2d point = center + spacing * Eigen::Vector2d(i, k);
      bool is_inside = true;
      for (size_t c = 0; c < outline.size(); ++c) {
        const Eigen::Vector2d edge = outline[(c + 1) % outline.size()] - outline[c];
        const Eigen::Vector2d from = point - outline[c];
        is_inside &= turn * (edge.x() * from.y() - edge.y() * from.x()) > 0;
      }
      if (is_inside) points.push_back(point);
    }
  }
  return points;
}

CollisionModel::CollisionModel(const RobotModel& model, const Tree& tree, int num_sole_points,
                               double spacing) {
  const int sole_links[] = {model.left_sole(), model.right_sole()};
  const std::vector<Eigen::Vector2d> outlines[] = {
      simplify_outline(model.left_sole_outline(), num_sole_points),
      simplify_outline(model.right_sole_outline(), num_sole_points)};
  bool has_sole[] = {false, false};

  for (size_t link = 0; link < model.links().size(); ++link) {
    const int index = static_cast<int>(link);
    for (const Shape& shape : model.links()[link].collisions) {
      Part part = part_of(shape, model.links()[link], tree.pose_in_body(index));
      part.link = index;
      part.body = tree.body_of_link(index);
      part.first_point = static_cast<int>(points.size());
      int sole = -1;
      // The part that carries the sole: the first shape of the body that has the sole's frame.
      // Further shapes of that body keep their own corners.
      for (int side = 0; side < 2; ++side) {
        const bool is_sole = sole_links[side] >= 0 && !has_sole[side] &&
                             tree.body_of_link(sole_links[side]) == part.body;
        if (is_sole) sole = side;
      }
      Eigen::Isometry3d body_in_sole = Eigen::Isometry3d::Identity();
      if (sole >= 0) {
        // The outline's corners replace the shape's own lower corners on the floor.
        has_sole[sole] = true;
        const Eigen::Isometry3d& pose = tree.pose_in_body(sole_links[sole]);
        body_in_sole = pose.inverse();
        std::vector<Eigen::Vector2d> contacts = spread(outlines[sole]);
        if (spacing > 0) {
          const std::vector<Eigen::Vector2d> inner = inner_points(outlines[sole], spacing);
          contacts.insert(contacts.end(), inner.begin(), inner.end());
        }
        for (const Eigen::Vector2d& corner : contacts) {
          const Vector3d in_body = pose * Vector3d(corner.x(), corner.y(), 0);
          points.push_back({in_body, 0, sole});
          const double to_corner = (in_body - part.center_in_body).norm();
          part.bounding_radius = std::max(part.bounding_radius, to_corner);
        }
      }
      // Corners of the shape itself, for a robot that lies on the floor.
      for (const Vector3d& corner : corners_of(part)) {
        // Corners within 1 mm of the sole's plane, or below it, are the lower ones.
        if (sole >= 0 && (body_in_sole * corner).z() - part.radius < 1e-3) continue;
        points.push_back({corner, part.radius, -1});
      }
      part.end_point = static_cast<int>(points.size());
      parts.push_back(part);
    }
  }

  for (const Point& point : points) {
    point_x.push_back(point.center_in_body.x());
    point_y.push_back(point.center_in_body.y());
    point_z.push_back(point.center_in_body.z());
    point_radius.push_back(point.radius);
  }

  // Largest distance of a surface point from the root's origin: the length of the chain of joint
  // origins at full stretch bounds it for all joint angles.
  for (const Part& part : parts) {
    double distance = part.center_in_body.norm() + part.bounding_radius;
    for (int body = part.body; body > 0; body = tree.bodies()[body].parent) {
      distance += tree.bodies()[body].origin_in_parent.norm();
    }
    reach = std::max(reach, distance);
  }

  // Pairs that are tested for self-collision: parts of one body do not move relative to each other,
  // and the model lists pairs of links that may touch.
  const auto& allowed = model.allowed_contacts();
  for (size_t i = 0; i < parts.size(); ++i) {
    for (size_t j = i + 1; j < parts.size(); ++j) {
      if (parts[i].body == parts[j].body) continue;
      const std::pair<int, int> links = std::minmax(parts[i].link, parts[j].link);
      if (std::find(allowed.begin(), allowed.end(), links) != allowed.end()) continue;
      self_pairs.emplace_back(i, j);
    }
  }
}

}  // namespace nao::sim
