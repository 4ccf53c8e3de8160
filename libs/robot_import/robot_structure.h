#pragma once

#include <Eigen/Geometry>
#include <array>
#include <vector>

#include "robot_import/finding.h"
#include "robot_import/urdf_repair.h"
#include "robot_model/robot_model.h"

namespace nao {

/** A sole that was found below a foot. */
struct FoundSole {
  /** Link of the foot. */
  int foot = -1;
  /** Frame of the sole: below the last joint's origin, on the surface that the foot stands on, with
   * the robot's heading at the angle 0 of all joints. */
  Eigen::Isometry3d pose_in_foot = Eigen::Isometry3d::Identity();
  /** Convex, counter-clockwise, m, in the sole's frame. */
  std::vector<Eigen::Vector2d> outline;
  /** Whether the foot is a point that no joint pitches: its outline is that of an assumed plate. */
  bool is_point = false;
  /** Whether a shape of the foot is above it; otherwise it needs one to stand on. */
  bool has_shape = true;
  /** Mass of the plate that is added there, kg: what holds a robot without legs. */
  double plate_mass = 0;
  /** Links of the foot's force sensors; empty: none. */
  std::vector<int> sensors;
};

/** Parts of a robot's body that follow from its structure; each left, right. */
struct RobotStructure {
  /** The robot's frame in that of its root: x ahead, y to the left, z up, its origin on the plane
   * of symmetry. The identity where the root's frame is as good. */
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
  std::array<FoundSole, 2> soles;
  /** Links; empty if there are no arms. */
  std::vector<int> hands;
};

/** Finds the frame, legs and arms of a humanoid in its tree.
 *
 * The plane of symmetry is the one that mirrors most joints onto others. Legs are the pair of
 * chains of at least three joints that reaches lower than every other part and hangs below the
 * center of mass of the rest. Ahead is where the feet are longer, and where the knees point.
 * A robot without legs stands on a heavy plate that is fixed to its root; its soles are the plate's
 * halves.
 * @param findings  Receives what was assumed. */
RobotStructure find_structure(const RobotModel& model, const MeshPoints& mesh_points,
                              Findings& findings);

/** Mirror images of the joints: a joint's image has its axis and place reflected in the plane of x
 * and z. A joint without an image is its own, with the sign 1. */
Symmetry find_symmetry(const RobotModel& model);

}  // namespace nao
