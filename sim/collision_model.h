#pragma once

#include <Eigen/Geometry>
#include <utility>
#include <vector>

#include "robot_model/robot_model.h"
#include "sim/tree.h"

namespace nao::sim {

/** A robot's collision primitives, made ready for contact. */
struct CollisionModel {
  /** A primitive fixed to a body: a rounded box, see RoundedBox. */
  struct Part {
    int link = -1;
    int body = -1;
    Eigen::Vector3d center_in_body = Eigen::Vector3d::Zero();
    Eigen::Matrix3d rotation_in_body = Eigen::Matrix3d::Identity();
    Eigen::Vector3d half = Eigen::Vector3d::Zero();
    double radius = 0;
    /** Of a sphere about the centre that holds the whole part, m. */
    double bounding_radius = 0;
    /** Its points in `points` that can touch the floor: first, and one past the last. */
    int first_point = 0;
    int end_point = 0;
  };
  /** A small ball fixed to a body that stands for a corner, an end or an edge on the floor. */
  struct Point {
    Eigen::Vector3d center_in_body = Eigen::Vector3d::Zero();
    double radius = 0;
    /** 0 left, 1 right sole, -1 elsewhere. */
    int sole = -1;
  };

  std::vector<Part> parts;
  std::vector<Point> points;
  /** Parts (the smaller index first) of one robot that must not pass through each other. */
  std::vector<std::pair<int, int>> self_pairs;

  /** @param num_sole_points  Corners that each sole keeps of its outline, 3 or more.
   * @throws ModelError  for a collision shape that is no box, sphere or capsule. */
  CollisionModel(const RobotModel& model, const Tree& tree, int num_sole_points);
};

/** Leaves out corners of a convex outline, always the one that costs the least area, until `count`
 * are left. */
std::vector<Eigen::Vector2d> simplify_outline(std::vector<Eigen::Vector2d> outline, int count);

}  // namespace nao::sim
