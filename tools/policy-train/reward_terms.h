#pragma once

#include <Eigen/Geometry>
#include <array>
#include <vector>

#include "policy/policy_manifest.h"
#include "robot_model/robot_model.h"

namespace nao::policy_train {

/** Terms of a reward, each without its weight; names in reward_term_names(). Most are those of
 * legged_gym and Booster Gym. */
enum class RewardTerm {
  /** exp(-error^2 / 0.25) of the horizontal velocity, m/s, and of the turn, rad/s. */
  kVelocityTracking,
  kTurnTracking,
  /** exp(-error^2 / 0.02) of their means, m/s and 2 rad/s: a step's swaying cancels in them. */
  kMeanVelocity,
  /** Squares of: the horizontal part of the unit vector down, of the torso; its height, as a
   * fraction of the standing one; its vertical speed, m/s; its rate of roll and pitch, rad/s. */
  kTilt,
  kHeight,
  kVerticalSpeed,
  kTiltRate,
  /** Means over the joints of the squares of: torque over peak torque; speed over greatest speed;
   * the change of the speed over the greatest speed; the change of the target, rad; a target beyond
   * the joint's range, rad. */
  kTorque,
  kJointSpeed,
  kJointAcceleration,
  kActionRate,
  kRange,
  /** Mean square of the angle to the default of joints whose mirrored angle has the other sign
   * (roll, yaw), and of all joints, rad. */
  kLateralPosture,
  kPosture,
  /** The last one while the robot is to stand, command 0, and the phase rests; and while a robot
   * that gets up stands. */
  kRestPosture,
  /** Feet, 0 to 2, that carry the robot, or do not, as the phase says. */
  kGait,
  /** Height of the sole that swings, as a fraction of the standing height, up to kClearance. */
  kClearance,
  /** Sum over feet on the ground of the square of their horizontal speed, m/s. */
  kSlip,
  /** Sum over both soles of the square of their tilt, rad, and of the yaw to the torso. */
  kSoleAngle,
  /** Square of what the soles are closer side by side than at the default angles, m. */
  kFootDistance,
  /** 1 in the step in which the robot falls; 1 in each other step. */
  kFallen,
  kAlive,
  /** Of a get-up: exp(-s / 8) while the robot stands, s the mean square of the joints' speeds,
   * rad/s, and 0 otherwise; the pull on its torso, see AssistSchedule, which has no
   * weight. */
  kStanding,
  kAssist,
  kCount
};
inline constexpr int kNumRewardTerms = static_cast<int>(RewardTerm::kCount);

/** "velocity_tracking", ..., in the order of RewardTerm. */
const std::array<const char*, kNumRewardTerms>& reward_term_names();

/** Height to which a swinging foot is rewarded to rise, as a fraction of the torso's. Chosen: a
 * NAO's gait lifts its feet by 0.06, a T1's by 0.09. */
inline constexpr double kClearance = 0.1;

/** The true motion of a robot at the end of a step, and its targets. */
struct MotionSample {
  Eigen::Isometry3d torso = Eigen::Isometry3d::Identity();
  /** In the torso's frame, rad/s and m/s. */
  Eigen::Vector3d angular_velocity = Eigen::Vector3d::Zero();
  Eigen::Vector3d linear_velocity = Eigen::Vector3d::Zero();
  /** Horizontal velocity in the frame of the torso's heading, m/s, and turn, rad/s, less the
   * commanded ones; means over about half a second. */
  Eigen::Vector3d velocity_error = Eigen::Vector3d::Zero();
  /** Force that pulls the torso up, as a fraction of the weight. */
  double assist = 0;
  /** In W; left, right. */
  std::array<Eigen::Isometry3d, 2> soles{Eigen::Isometry3d::Identity(),
                                         Eigen::Isometry3d::Identity()};
  /** Force on each sole, as a fraction of the weight. */
  std::array<double, 2> load{};
  /** Motor order: rad, rad/s, N m, rad. */
  Eigen::VectorXd position;
  Eigen::VectorXd velocity;
  Eigen::VectorXd torque;
  Eigen::VectorXd target;
};

/** Velocity in the frame of the torso's heading, m/s. */
Eigen::Vector3d velocity_in_heading(const MotionSample& sample);

/** Computes the terms of a step.
 * @param start      At the default angles, standing.
 * @param before, after  At the begin and the end of the step.
 * @param command    Velocity, m/s and rad/s. @param phase  Cycles, 0 to 1.
 * @param fallen     Whether the robot fell in this step.
 * @param terms      Receives (kNumRewardTerms). */
void calc_reward_terms(const RobotModel& model, const PolicyManifest& manifest,
                       const MotionSample& start, const MotionSample& before,
                       const MotionSample& after, const Eigen::Vector3d& command, double phase,
                       bool fallen, float* terms);

/** Whether the robot is to stand: at command 0, unless the phase goes on. */
bool is_at_rest(const PolicyManifest& manifest, const Eigen::Vector3d& command);

/** Whether a foot is to swing. The left one swings about a quarter of the cycle, the right one
 * about three quarters, each for 0.4 of it; at rest none does.
 * @param foot  0 left, 1 right. */
bool is_swing(const PolicyManifest& manifest, const Eigen::Vector3d& command, double phase,
              int foot);

}  // namespace nao::policy_train
