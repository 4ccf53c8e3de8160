#pragma once

#include <Eigen/Geometry>
#include <array>
#include <string>
#include <vector>

#include "robot_import/finding.h"
#include "robot_model/robot_model.h"

namespace nao {

/** A sole that was found below a foot. */
struct FoundSole {
  /** Link of the foot. */
  int foot = -1;
  /** Frame of the sole: below the last joint's origin, on the foot's lowest points, with the root's
   * axes at the angle 0 of all joints. */
  Eigen::Isometry3d pose_in_foot = Eigen::Isometry3d::Identity();
  /** Convex, counter-clockwise, m, in the sole's frame. */
  std::vector<Eigen::Vector2d> outline;
  /** Links of the foot's force sensors; empty: none. */
  std::vector<int> sensors;
};

/** Parts of a robot's body that follow from its structure; each left, right. */
struct RobotStructure {
  std::array<FoundSole, 2> soles;
  /** Links; empty if there are no arms. */
  std::vector<int> hands;
};

/** Finds the legs and arms of a humanoid in its tree: mirrored pairs of chains, of which the legs
 * reach lowest.
 *
 * x is ahead, y to the left, z up, in the root's frame at the angle 0 of all joints.
 * @param findings  Receives what was assumed.
 * @throws ModelError  if it does not find two legs. */
RobotStructure find_structure(const RobotModel& model, Findings& findings);

/** Mirror images of the joints: a joint's image has its axis and place reflected in the plane of x
 * and z. A joint without an image is its own, with the sign 1. */
Symmetry find_symmetry(const RobotModel& model);

}  // namespace nao
