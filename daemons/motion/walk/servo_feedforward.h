#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "kinematics/kinematics.h"
#include "robot_model/robot_model.h"

namespace nao::motion {

/** Ground reaction force on one foot, in the torso frame. */
struct FootLoad {
  /** N. */
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  /** Where it acts, m. */
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
};

/** Offsets of position targets that make the servos follow under load.
 *
 * A servo gives torque = stiffness_gain * (target - angle) - damping_gain * velocity, less the
 * losses of the moving motor. A target ahead by (required torque + losses) / stiffness_gain removes
 * the static and the velocity error. A required torque, as of an ankle that moves the zero moment
 * point, is an offset of the target in the same way. */
class ServoFeedforward {
 public:
  /** @param model  Must outlive this. */
  explicit ServoFeedforward(const RobotModel& model);

  /** Static joint torques, N m, (num_motors): the weight of the links less what the ground carries,
   *
   *     tau = m g up^T J_com - sum_i f_i^T J_i   (virtual work with the torso fixed).
   *
   * @param kinematics  Kinematics of the commanded angles. @param up  Unit vector upwards, torso
   * frame.
   * @param loads       Left foot, right foot. */
  std::vector<double> calc_torques(const Kinematics& kinematics, const Eigen::Vector3d& up,
                                   const std::array<FootLoad, 2>& loads) const;

  /** Inertia of all that a motor moves, about its axis in the ready posture with the rest of the
   * robot at rest, rotor included, kg m^2: the torque per acceleration of a leg in the air. */
  double inertia(int motor) const { return inertia_[motor]; }

  /** Offset of a motor's target, rad, for a torque, N m, clamped to the motor's peak, and a
   * velocity, rad/s. @param velocity_scale  Fraction of the velocity-dependent losses to
   * compensate. */
  double calc_offset(int motor, double torque, double velocity, double velocity_scale) const;

 private:
  const RobotModel* model_;
  std::vector<double> inertia_;
};

}  // namespace nao::motion
