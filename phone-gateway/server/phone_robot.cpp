#include "phone-gateway/server/phone_robot.h"

#include "common/yaml_entry.h"

namespace nao {
namespace {

std::string motor_name(const RobotModel& model, int motor) {
  return motor < 0 ? "" : model.motor_joint(motor).name;
}

/** File name of the URDF that robot.yaml names. RobotModel has checked that it is in its folder. */
std::string urdf_name(const RobotModel& model) {
  return YamlEntry::load(model.folder() / "robot.yaml").at("urdf").text();
}

}  // namespace

PhoneRobot describe_robot(const std::string& name, const RobotModel& model) {
  PhoneRobot robot;
  robot.walk_limits = model.walk_limits();
  naoremote::RobotDescription& description = robot.description;
  description.set_name(name);
  description.set_model(model.folder().filename().string());
  description.set_urdf_path("/robots/" + description.model() + "/" + urdf_name(model));
  for (int motor = 0; motor < model.num_motors(); ++motor) {
    const Joint& joint = model.motor_joint(motor);
    naoremote::Joint* described = description.add_joints();
    described->set_name(joint.name);
    described->set_lower(joint.lower);
    described->set_upper(joint.upper);
    described->set_max_velocity(joint.max_velocity);
  }
  for (const Posture& posture : model.postures()) description.add_postures(posture.name);
  for (const std::string& action : model.actions()) description.add_actions(action);
  for (const JointGroup& group : model.joint_groups()) {
    naoremote::JointGroup* described = description.add_joint_groups();
    described->set_name(group.name);
    described->set_yaw_joint(motor_name(model, group.yaw_motor));
    described->set_pitch_joint(motor_name(model, group.pitch_motor));
    described->set_roll_joint(motor_name(model, group.roll_motor));
  }
  for (const CameraModel& camera : model.cameras()) description.add_cameras(camera.name);
  description.set_max_vx(robot.walk_limits.forward);
  description.set_min_vx(-robot.walk_limits.backward);
  description.set_max_vy(robot.walk_limits.sideways);
  description.set_max_wz(robot.walk_limits.turning);
  return robot;
}

}  // namespace nao
