#include "daemons/motion/walk/servo_feedforward.h"

#include <algorithm>

#include "common/constants.h"

namespace nao::motion {
namespace {

/** Whether a joint moves a link. */
bool moves(const RobotModel& model, int joint, int link) {
  int at = model.links()[link].parent_joint;
  while (at >= 0 && at != joint) at = model.links()[model.joints()[at].parent_link].parent_joint;
  return at >= 0;
}

/** Inertia of the links beyond a joint about its axis, kg m^2. */
double calc_inertia(const Kinematics& kinematics, int joint) {
  const RobotModel& model = kinematics.model();
  const Eigen::Isometry3d& pose = kinematics.link_pose(model.joints()[joint].child_link);
  const Eigen::Vector3d axis = pose.linear() * model.joints()[joint].axis;
  double inertia = 0;
  for (size_t i = 0; i < model.links().size(); ++i) {
    const Link& link = model.links()[i];
    const Eigen::Isometry3d& link_pose = kinematics.link_pose(static_cast<int>(i));
    if (link.mass == 0 || !moves(model, joint, static_cast<int>(i))) continue;
    // Parallel-axis theorem: about the link's center of mass, and of its mass at its distance.
    const Eigen::Vector3d in_link = link_pose.linear().transpose() * axis;
    const Eigen::Vector3d arm = link_pose * link.center_of_mass - pose.translation();
    inertia += in_link.dot(link.inertia * in_link) + link.mass * axis.cross(arm).squaredNorm();
  }
  return inertia;
}

}  // namespace

ServoFeedforward::ServoFeedforward(const RobotModel& model) : model_(&model) {
  Kinematics kinematics(model);
  kinematics.update(model.ready_posture().position);
  for (int motor = 0; motor < model.num_motors(); ++motor) {
    inertia_.push_back(model.motor(motor).reflected_inertia +
                       calc_inertia(kinematics, model.motors()[motor]));
  }
}

std::vector<double> ServoFeedforward::calc_torques(const Kinematics& kinematics,
                                                   const Eigen::Vector3d& up,
                                                   const std::array<FootLoad, 2>& loads) const {
  // Virtual work: gravity m g up . J_com, less the work of the ground reaction at each foot, f .
  // J_foot, in the torso frame. The result is the static torque of each motor, N m.
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
  // A position servo with u = kp (target - angle) - losses gives the torque at a target that is
  // ahead by (torque + losses) / kp, rad.
  return (std::clamp(torque, -peak, peak) + velocity_scale * loss * velocity) /
         drive.stiffness_gain;
}

}  // namespace nao::motion
