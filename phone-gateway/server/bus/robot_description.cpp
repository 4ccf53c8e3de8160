#include "phone-gateway/server/bus/robot_description.h"

namespace nao::gateway {
namespace {

/** Empty for an axis that the group does not have. */
std::string motor_name(const RobotModel& model, int motor) {
  return motor < 0 ? "" : model.motor_joint(motor).name;
}

}  // namespace

naoremote::RobotDescription describe_robot(const std::string& name, const RobotModel& model) {
  naoremote::RobotDescription robot;
  robot.set_name(name);
  robot.set_model(model.folder().filename().string());
  robot.set_urdf_path("/robots/" + robot.model() + "/" + model.urdf_file().filename().string());
  for (int motor = 0; motor < model.num_motors(); ++motor) {
    const Joint& joint = model.motor_joint(motor);
    naoremote::Joint& described = *robot.add_joints();
    described.set_name(joint.name);
    described.set_lower(joint.lower);
    described.set_upper(joint.upper);
    described.set_max_velocity(joint.max_velocity);
  }
  for (const Posture& posture : model.postures()) robot.add_postures(posture.name);
  for (const std::string& action : model.actions()) robot.add_actions(action);
  for (const JointGroup& group : model.joint_groups()) {
    naoremote::JointGroup& described = *robot.add_joint_groups();
    described.set_name(group.name);
    described.set_yaw_joint(motor_name(model, group.yaw_motor));
    described.set_pitch_joint(motor_name(model, group.pitch_motor));
    described.set_roll_joint(motor_name(model, group.roll_motor));
  }
  for (const CameraModel& camera : model.cameras()) robot.add_cameras(camera.name);
  const WalkLimits& limits = model.walk_limits();
  robot.set_max_vx(limits.forward);
  robot.set_min_vx(-limits.backward);
  robot.set_max_vy(limits.sideways);
  robot.set_max_wz(limits.turning);
  return robot;
}

}  // namespace nao::gateway
