#pragma once

#include <atomic>
#include <optional>
#include <string>
#include <vector>

#include "daemons/motion/actions/taught_script.h"
#include "daemons/motion/guards/self_collision_guard.h"
#include "robot_model/robot_model.h"
#include "sim/closed_loop/closed_loop.h"

namespace nao {

/** Result of checking a taught motion. */
struct MotionReport {
  /** Nothing if the motion is safe. */
  std::optional<motion::MotionFault> fault;
  /** The motion, in which angles beyond their limits by no more than the tolerance of a measured
   * pose are moved to the limits. */
  motion::ActionScript script;
  /** A changed motion without the fault, if one was found, and what was changed: "slowed-down" or
   * "clipped". */
  std::optional<motion::ActionScript> repaired;
  std::string repair;
};

/** Checks whether a robot can play a taught motion: limits and speeds of the joints and distances
 * of the links along the path, by geometry; contact and balance by simulations of the whole motion
 * with several draws of the default disturbances. Simulating takes seconds. */
class MotionChecker {
 public:
  /** @param options  Model, scene, engine and disturbances of the simulations. */
  explicit MotionChecker(const ClosedLoopOptions& options);

  MotionReport check(const motion::ActionScript& script);
  /** Ends a check that another thread makes, with some fault. No check is possible afterwards. */
  void cancel() { is_cancelled_ = true; }

  /** The faults that need no simulation, first keyframe first. */
  std::optional<motion::MotionFault> find_static_fault(const motion::ActionScript& script);
  /** The faults that simulations show. */
  std::optional<motion::MotionFault> find_dynamic_fault(const motion::ActionScript& script) const;

 private:
  /** Targets of each keyframe, motor order, rad; the first is the start posture's. */
  std::vector<std::vector<double>> calc_targets(const motion::ActionScript& script) const;
  std::optional<motion::MotionFault> find_limit_fault(const motion::ActionScript& script) const;
  std::optional<motion::MotionFault> find_speed_fault(const motion::ActionScript& script) const;
  std::optional<motion::MotionFault> find_collision(const motion::ActionScript& script);
  /** Moves angles to their limits that are beyond them by up to `tolerance`, rad. */
  void clip(motion::ActionScript& script, double tolerance) const;
  /** Lengthens keyframes that are too short for a motor, and all by a factor. */
  void slow_down(motion::ActionScript& script, double factor) const;
  /** Searches for a changed motion without a fault. */
  void repair(MotionReport& report);

  ClosedLoopOptions options_;
  const RobotModel* model_;
  motion::SelfCollisionGuard guard_;
  std::atomic<bool> is_cancelled_ = false;
};

}  // namespace nao
