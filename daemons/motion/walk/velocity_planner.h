#pragma once

#include <Eigen/Core>

#include "daemons/motion/walk/gait.h"
#include "daemons/motion/walk/path_tracker.h"
#include "kinematics/pose2.h"
#include "robot_model/robot_model.h"

namespace nao::motion {

/** Chooses the velocity of each step: the commanded velocity, clipped to the robot's envelope and
 * limited in its change per step, plus the correction that leads back to the path.
 *
 * All velocities are in the body frame: m/s ahead, m/s to the left, rad/s. */
class VelocityPlanner {
 public:
  VelocityPlanner(const RobotModel& model, const Gait& gait);

  /** @param slowness  0: the envelope has the robot's limits and envelope_exponent; 1: slow_speed
   * of the limits ahead and sideways, slow_turning of that of turns, and slow_envelope_exponent;
   * linear between. */
  void set_slowness(double slowness) { slowness_ = slowness; }

  /** The greatest velocity along the direction of the given one that lies in the envelope
   * sum (|v_i| / max_i)^p <= 1, or the given one if it does. */
  Eigen::Vector3d clip(const Eigen::Vector3d& velocity) const;

  /** Moves from one velocity towards another by at most the change that one step allows. */
  Eigen::Vector3d ramp(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const;

  /** Sets both velocities to zero. */
  void stop();

  /** Starts a path at the body. @param body  In odometry. */
  void start_path(const Pose2& body) { path_.reset(body); }

  /** Chooses the velocity of the step that begins.
   * @param commanded    May exceed the envelope. @param body  In odometry.
   * @param is_ending    The walk ends: the change of velocity is not limited.
   * @param tracks_path  If false, the path restarts at the body. */
  void begin_step(const Eigen::Vector3d& commanded, const Pose2& body, bool is_ending,
                  bool tracks_path);

  /** Moves the path by one tick. */
  void advance(double dt) { path_.advance(velocity_, dt); }

  /** Commanded velocity after clipping and ramping. */
  const Eigen::Vector3d& velocity() const { return velocity_; }
  /** The same with the path's correction; the footsteps are planned for it. */
  const Eigen::Vector3d& step_velocity() const { return step_velocity_; }

 private:
  const Gait::Velocity* gait_;
  WalkLimits limits_;
  double slowness_ = 0;
  PathTracker path_;
  Eigen::Vector3d velocity_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d step_velocity_ = Eigen::Vector3d::Zero();
};

}  // namespace nao::motion
