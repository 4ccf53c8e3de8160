#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "robot_model/closest_points.h"

namespace nao::sim {

/** One side of a contact: a robot's link, the floor, the ball, a goal's posts and crossbar, or a
 * goal's net. */
struct Surface {
  enum class Kind { kFloor, kRobot, kBall, kGoal, kNet };
  Kind kind = Kind::kFloor;
  /** For kRobot: indices of the robot in the world and of its link. */
  int robot = -1;
  int link = -1;
};

/** A contact point with a force. */
struct Contact {
  Surface a;
  Surface b;
  /** In W, m. */
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  /** In W, N; the opposite force acts on b. */
  Eigen::Vector3d force_on_a = Eigen::Vector3d::Zero();
};

/** State that one possible contact keeps from one step to the next. */
struct ContactMemory {
  /** Impulse of the last step, N s, in W: the start value of the solver (warm start). */
  Eigen::Vector3d impulse = Eigen::Vector3d::Zero();
  /** Deflection of the tangential friction spring, m, in W. */
  Eigen::Vector3d spring_deflection = Eigen::Vector3d::Zero();
  /** The last step in which the contact was a constraint. */
  int64_t last_step = -2;
  /** Direction from b to a in which two shapes were apart when their distance was last measured, in
   * W; 0 if it never was. */
  Eigen::Vector3d separating_axis = Eigen::Vector3d::Zero();
};

/** Two surfaces that are expected to be closer than the contact margin after the step. */
struct ContactCandidate {
  // Defaulted in a source file: emplace_back() would zero all of it before its initializers do.
  ContactCandidate();

  Surface a;
  Surface b;
  /** Bodies in their robots' trees; -1 where the surface is not a robot's. */
  int body_a = -1;
  int body_b = -1;
  /** Foot that surface a's point belongs to: 0 left, 1 right, -1 none. */
  int foot = -1;
  /** Distance and normal (from b to a) at the start of the step. */
  Proximity proximity;
  /** Speed at which the surfaces approach each other along the normal, m/s; negative: separating.
   */
  double approach_speed = 0;
  /** Owned by the ContactDetector. Never null. */
  ContactMemory* memory = nullptr;
};

}  // namespace nao::sim
