#include "phone-gateway/server/bus/robot_description.h"

namespace nao::gateway {
namespace {

/** Empty for an axis that the group does not have. */
std::string motor_name(const RobotModel& model, int motor) {
  return motor < 0 ? "" : model.motor_joint(motor).name;
}

const char* name_of(Action::Kind kind) {
  switch (kind) {
    case Action::Kind::kStandUp:
      return "stand-up";
    case Action::Kind::kRest:
      return "rest";
    case Action::Kind::kKick:
      return "kick";
    case Action::Kind::kBlock:
      return "block";
    case Action::Kind::kDive:
      return "dive";
    case Action::Kind::kGesture:
      return "gesture";
  }
  return "";
}

const char* name_of(Side side) {
  return side == Side::kNone ? "" : side == Side::kLeft ? "left" : "right";
}

/** Name of the group that turns the first camera: it has the first joint between root and camera.
 */
std::string find_camera_group(const RobotModel& model) {
  if (model.cameras().empty()) return "";
  for (const int joint : model.find_chain(model.cameras().front().link)) {
    const int motor = model.motor_of(joint);
    for (const JointGroup& group : model.joint_groups()) {
      if (motor >= 0 && (group.yaw_motor == motor || group.pitch_motor == motor)) return group.name;
    }
  }
  return "";
}

void describe_words(const RobotModel& model, naoremote::RobotDescription& robot) {
  const MotionReferences& references = model.references();
  robot.set_ready_posture(references.ready);
  robot.set_stand_posture(references.stand);
  robot.set_rest_posture(references.rest);
  robot.set_camera_group(find_camera_group(model));
  for (const Action& action : model.actions()) {
    naoremote::ActionRole& role = *robot.add_action_roles();
    role.set_name(action.name);
    role.set_kind(name_of(action.kind));
    role.set_side(name_of(action.side));
  }
  for (const Label& label : model.labels()) {
    for (const auto& [language, text] : label.texts) {
      naoremote::Label& described = *robot.add_labels();
      described.set_kind(label.kind);
      described.set_name(label.name);
      described.set_language(language);
      described.set_text(text);
    }
  }
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
  for (const Action& action : model.actions()) robot.add_actions(action.name);
  for (const JointGroup& group : model.joint_groups()) {
    naoremote::JointGroup& described = *robot.add_joint_groups();
    described.set_name(group.name);
    described.set_yaw_joint(motor_name(model, group.yaw_motor));
    described.set_pitch_joint(motor_name(model, group.pitch_motor));
    described.set_roll_joint(motor_name(model, group.roll_motor));
    described.set_is_opening(group.is_opening);
  }
  for (const CameraModel& camera : model.cameras()) robot.add_cameras(camera.name);
  const WalkLimits& limits = model.walk_limits();
  robot.set_max_vx(limits.forward);
  robot.set_min_vx(-limits.backward);
  robot.set_max_vy(limits.sideways);
  robot.set_max_wz(limits.turning);
  describe_words(model, robot);
  return robot;
}

}  // namespace nao::gateway
