#include "phone-gateway/server/bus/robot_description.h"

#include "messages/speech_command.h"
#include "phone-gateway/server/core/streams.h"
#include "robot_model/action_kinds.h"
#include "robot_model/camera_group.h"
#include "robot_model/robot_lights.h"

namespace nao::gateway {
namespace {

/** Empty for an axis that the group does not have. */
std::string motor_name(const RobotModel& model, int motor) {
  return motor < 0 ? "" : model.motor_joint(motor).name;
}

const char* name_of(Side side) {
  return side == Side::kNone ? "" : side == Side::kLeft ? "left" : "right";
}

void add_label(naoremote::RobotDescription& robot, const std::string& kind, const std::string& name,
               const std::string& language, const std::string& text) {
  naoremote::Label& label = *robot.add_labels();
  label.set_kind(kind);
  label.set_name(name);
  label.set_language(language);
  label.set_text(text);
}

void describe_lights(const RobotModel& model, naoremote::RobotDescription& robot) {
  for (const RobotLight& light : load_robot_lights(model)) {
    naoremote::Light& described = *robot.add_lights();
    described.set_name(light.name);
    described.set_link(model.links()[static_cast<size_t>(light.link)].name);
    for (const RobotLight::Disc& disc : light.discs) {
      naoremote::Light::Disc& described_disc = *described.add_discs();
      for (const double x : disc.center) described_disc.add_center(static_cast<float>(x));
      for (const double x : disc.normal) described_disc.add_normal(static_cast<float>(x));
      described_disc.set_radius(static_cast<float>(disc.radius));
      described_disc.set_inner_radius(static_cast<float>(disc.inner_radius));
    }
    for (const auto& [language, text] : light.labels) {
      add_label(robot, "light", light.name, language, text);
    }
  }
}

void describe_words(const RobotModel& model, naoremote::RobotDescription& robot) {
  const MotionReferences& references = model.references();
  robot.set_ready_posture(references.ready);
  robot.set_stand_posture(references.stand);
  robot.set_rest_posture(references.rest);
  if (const JointGroup* group = find_camera_group(model)) robot.set_camera_group(group->name);
  for (const Action& action : model.actions()) {
    naoremote::ActionRole& role = *robot.add_action_roles();
    role.set_name(action.name);
    role.set_kind(std::string(kActionKinds[static_cast<size_t>(action.kind)]));
    role.set_side(name_of(action.side));
  }
  for (const Label& label : model.labels()) {
    for (const auto& [language, text] : label.texts) {
      add_label(robot, label.kind, label.name, language, text);
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
    const MirrorMotor& mirror = model.symmetry().mirrors[static_cast<size_t>(motor)];
    described.set_mirror_joint(motor_name(model, mirror.motor));
    described.set_mirror_sign(mirror.sign);
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
  for (const std::string_view language : kSpeechLanguages) {
    robot.add_languages(std::string(language));
  }
  describe_lights(model, robot);
  describe_words(model, robot);
  return robot;
}

void add_overview(naoremote::RobotDescription& robot) {
  robot.add_cameras(kOverviewCamera);
  add_label(robot, "camera", kOverviewCamera, "en", "Overview");
  add_label(robot, "camera", kOverviewCamera, "pt", "Vista geral");
  add_label(robot, "camera", kOverviewCamera, "de", "Übersicht");
  add_label(robot, "camera", kOverviewCamera, "ar", "نظرة عامة");
}

}  // namespace nao::gateway
