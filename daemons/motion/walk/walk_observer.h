#pragma once

#include <Eigen/Geometry>
#include <array>

#include "daemons/motion/estimator/gyroscope_filter.h"
#include "daemons/motion/robot_state.h"
#include "daemons/motion/walk/com_reference.h"
#include "daemons/motion/walk/gait.h"
#include "daemons/motion/walk/pendulum_estimator.h"
#include "kinematics/pose2.h"

namespace nao::motion {

/** Measurements that the walk uses: center of mass over the support foot, tilt and angular velocity
 * of the torso, load on the swing foot, soles in odometry. */
class WalkObserver {
 public:
  explicit WalkObserver(const Gait& gait)
      : estimator_(gait.feedback.max_com_offset, gait.feedback.com_offset_gain) {}

  /** Forgets the estimate of a previous walk. @param is_pushed  The robot moves already. */
  void start(bool is_pushed = false);

  /** Takes in one tick.
   * @param com_in_torso     From the measured joint angles, m.
   * @param support_is_left  The support foot now.
   * @param reference        Gives the pendulum's frequency and the commanded ZMP.
   * @param torso_pitch      Commanded, rad. */
  void update(const RobotState& state, const Eigen::Vector3d& com_in_torso, bool support_is_left,
              const ComReference& reference, double torso_pitch, double dt);

  /** Center of mass in the support frame S, without the estimated offset of the measurement.
   *
   * The present measurement results from the command one lag ago, but is compared with the present
   * reference: see docs/decisions/walk-design.md. */
  const PendulumState& com() const { return com_; }
  /** Rotation of the torso relative to its commanded orientation: roll, pitch, 0; rad. */
  const Eigen::Vector3d& tilt() const { return tilt_; }
  /** Angular velocity of the torso, low-pass filtered, rad/s, torso frame. */
  const Eigen::Vector3d& angular_velocity() const { return gyroscope_.value(); }
  /** Load on the foot that was the swing foot in the last update(), N. */
  double swing_force() const { return swing_force_; }
  const Pose2& sole_in_odometry(bool is_left) const { return soles_in_odometry_[is_left ? 0 : 1]; }
  /** Midpoint of the soles, with the torso's heading, in odometry. */
  Pose2 midpoint_in_odometry() const;

 private:
  void estimate_com(const RobotState& state, const Eigen::Vector3d& com_in_torso,
                    bool support_is_left, const ComReference& reference, double dt);

  PendulumEstimator estimator_;
  bool has_estimate_ = false;
  bool starts_pushed_ = false;
  /** At the last update. */
  bool support_was_left_ = true;
  double support_heading_ = 0;

  PendulumState com_;
  GyroscopeFilter gyroscope_;
  Eigen::Vector3d tilt_ = Eigen::Vector3d::Zero();
  double torso_heading_ = 0;
  double swing_force_ = 0;
  /** Left, right. */
  std::array<Pose2, 2> soles_in_odometry_;
};

}  // namespace nao::motion
