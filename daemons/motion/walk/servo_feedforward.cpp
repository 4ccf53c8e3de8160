#include "daemons/motion/walk/servo_feedforward.h"

#include <algorithm>

#include "common/constants.h"

namespace nao::motion {

ServoFeedforward::ServoFeedforward(const RobotModel& model) : model_(&model) {}

std::vector<double> ServoFeedforward::calc_torques(const Kinematics& kinematics,
                                                   const Eigen::Vector3d& up,
                                                   const std::array<FootLoad, 2>& loads) const {
  Eigen::RowVectorXd torque =
      kinematics.mass() * kGravity * up.transpose() * kinematics.calc_center_of_mass_jacobian();
  const std::array<int, 2> soles = {model_->left_sole(), model_->right_sole()};
  for (size_t i = 0; i < loads.size(); ++i) {
    // A foot in the air costs no Jacobian.
    if (loads[i].force.isZero(0)) continue;
    torque -= loads[i].force.transpose() * kinematics.calc_point_jacobian(soles[i], loads[i].point);
  }
  return {torque.data(), torque.data() + torque.size()};
}

double ServoFeedforward::calc_offset(int motor, double torque, double velocity,
                                     double velocity_scale) const {
  const Motor& drive = model_->motor(motor);
  const double peak = model_->motor_joint(motor).max_torque;
  // N m s/rad: the servo's damping term, the back-EMF (torque falls linearly to zero at the no-load
  // velocity), and viscous friction.
  const double loss = drive.damping_gain + peak / drive.no_load_velocity + drive.viscous_friction;
  return (std::clamp(torque, -peak, peak) + velocity_scale * loss * velocity) /
         drive.stiffness_gain;
}

}  // namespace nao::motion
