#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "kinematics/kinematics.h"
#include "robot_model/robot_model.h"

namespace nao::motion {

/** What the floor does to one foot, in the torso frame. */
struct FootLoad {
  /** N. */
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  /** Where it acts, m. */
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
};

/** How far position servos must aim beyond the wished angles to reach them under load.
 *
 * A servo gives torque = gain * (target - angle) - damping * velocity, less what the moving motor
 * loses. Aiming ahead by (needed torque + losses) / gain makes it follow without lag, and makes a
 * wished torque (an ankle's, for balance) a plain addition to the target. */
class ServoFeedforward {
 public:
  explicit ServoFeedforward(const RobotModel& model);

  /** Torques that hold the robot up, N m, (num_motors): weight of the parts beyond each joint, less
   * what the floor carries.
   * @param kinematics  Of the angles wished for. @param up  Vertical, torso frame.
   * @param loads       Left foot, right foot. */
  std::vector<double> calc_torques(const Kinematics& kinematics, const Eigen::Vector3d& up,
                                   const std::array<FootLoad, 2>& loads) const;

  /** Offset of a motor's target for a torque and a velocity, rad. @param damping_share  Share of
   * the velocity's losses to make up for. */
  double calc_offset(int motor, double torque, double velocity, double damping_share) const;

 private:
  const RobotModel* model_;
};

}  // namespace nao::motion
