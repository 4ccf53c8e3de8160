#pragma once

#include <Eigen/Geometry>
#include <utility>
#include <vector>

#include "robot_model/robot_model.h"
#include "sim/tree.h"

namespace nao::sim {

/** A robot's collision primitives in the form that contact detection needs. */
struct CollisionModel {
  /** A primitive fixed to a body: a rounded box, see RoundedBox. */
  struct Part {
    int link = -1;
    int body = -1;
    Eigen::Vector3d center_in_body = Eigen::Vector3d::Zero();
    Eigen::Matrix3d rotation_in_body = Eigen::Matrix3d::Identity();
    Eigen::Vector3d half = Eigen::Vector3d::Zero();
    double radius = 0;
    /** Radius of the sphere about the center that contains the whole part, m. */
    double bounding_radius = 0;
    /** Its points in `points`, which collide with the floor: the first, and one past the last. */
    int first_point = 0;
    int end_point = 0;
  };
  /** A sphere fixed to a body, by which a corner or an end of a part collides with the floor. */
  struct Point {
    Eigen::Vector3d center_in_body = Eigen::Vector3d::Zero();
    double radius = 0;
    /** Sole that it is a corner of: 0 left, 1 right, -1 none. */
    int sole = -1;
  };

  std::vector<Part> parts;
  std::vector<Point> points;
  /** Centers and radii of `points`, one after the other, for loops over all. */
  std::vector<double> point_x;
  std::vector<double> point_y;
  std::vector<double> point_z;
  std::vector<double> point_radius;
  /** Pairs of parts (the smaller index first) that collide with each other: on different bodies,
   * and not allowed to touch by robot.yaml's contact_clusters. */
  std::vector<std::pair<int, int>> self_pairs;
  /** Upper bound of the distance from the root's origin to any point of the robot, m, at all joint
   * angles. */
  double reach = 0;

  /** @param num_sole_points  Corners that each sole keeps of its outline, 3 or more.
   * @param spacing  Distance between further points of the soles within the outline, m; 0: none.
   * @throws ModelError  for a collision shape that is not a box, sphere or capsule. */
  CollisionModel(const RobotModel& model, const Tree& tree, int num_sole_points, double spacing);
};

/** Points of a square grid that lie within a convex outline, m. @param spacing  Spacing of the
 * grid, above 0.
 */
std::vector<Eigen::Vector2d> inner_points(const std::vector<Eigen::Vector2d>& outline,
                                          double spacing);

/** Removes corners from a convex outline until `count` are left, each time the one whose removal
 * loses the least area (Visvalingam and Whyatt, Line Generalisation by Repeated Elimination of
 * Points, 1993). */
std::vector<Eigen::Vector2d> simplify_outline(std::vector<Eigen::Vector2d> outline, int count);

}  // namespace nao::sim
