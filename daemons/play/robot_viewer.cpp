#include "daemons/play/robot_viewer.h"

#include <cmath>
#include <filesystem>

#include "common/error.h"
#include "common/yaml_entry.h"
#include "robot_model/camera_group.h"
#include "robot_model/scene_file.h"

namespace nao::play {
namespace {

constexpr const char* kKickFile = "actions/kick.yaml";

std::string name_of_action(const RobotModel& model, Action::Kind kind, Side side = Side::kNone) {
  const Action* action = model.find_action(kind, side);
  return action == nullptr ? "" : action->name;
}

/** Name of a motor's joint, and its limits. */
std::string read_joint(const RobotModel& model, int motor, double& lower, double& upper) {
  if (motor < 0) return "";
  const Joint& joint = model.motor_joint(motor);
  lower = joint.lower;
  upper = joint.upper;
  return joint.name;
}

}  // namespace

RobotViewer::RobotViewer(const RobotModel& model) : model_(model), kinematics_(model) {
  if (const JointGroup* group = find_camera_group(model)) {
    yaw_motor_ = group->yaw_motor;
    pitch_motor_ = group->pitch_motor;
  }
  head_joints_ = {
      read_joint(model, yaw_motor_, head_limits_.least_yaw, head_limits_.greatest_yaw),
      read_joint(model, pitch_motor_, head_limits_.least_pitch, head_limits_.greatest_pitch)};
}

RobotView RobotViewer::look(const Eigen::Isometry3d& torso_in_odometry,
                            const std::vector<double>& position) {
  kinematics_.update(position);
  RobotView view;
  view.torso_in_odometry = Pose2::from(torso_in_odometry);
  const Eigen::Vector3d middle =
      torso_in_odometry * Eigen::Vector3d(0.5 * (kinematics_.left_sole().translation() +
                                                 kinematics_.right_sole().translation()));
  view.feet_in_odometry = {middle.head<2>(), view.torso_in_odometry.heading};
  if (yaw_motor_ >= 0) view.head_yaw = position[static_cast<size_t>(yaw_motor_)];
  if (pitch_motor_ >= 0) view.head_pitch = position[static_cast<size_t>(pitch_motor_)];
  // F: on the ground between the soles, with the torso's heading.
  Eigen::Isometry3d feet = Eigen::Isometry3d::Identity();
  feet.translation().head<2>() = middle.head<2>();
  feet.linear() =
      Eigen::AngleAxisd(view.feet_in_odometry.heading, Eigen::Vector3d::UnitZ()).matrix();
  const Eigen::Isometry3d torso_in_feet = feet.inverse() * torso_in_odometry;
  for (const CameraModel& camera : model_.cameras()) {
    const Eigen::Isometry3d pose = torso_in_feet * kinematics_.link_pose(camera.link);
    const Eigen::Vector3d axis = pose.linear().col(0);
    view.cameras.push_back({camera.name, pose.translation(), std::atan2(axis.y(), axis.x()),
                            std::atan2(-axis.z(), axis.head<2>().norm())});
  }
  return view;
}

PlayConstants load_constants(const RobotModel& model, const std::string& scene) {
  const SceneFile file = SceneFile::find(scene);
  if (!file.field || !file.goals) {
    throw ConfigError("the scene " + scene + " has no field with goals; behaviors need one");
  }
  PlayConstants constants;
  constants.field = {file.field->length,
                     file.field->width,
                     file.goals->post_distance - file.goals->post_diameter,
                     file.goals->post_offset + file.goals->depth,
                     {file.field->goal_area_length, file.field->goal_area_width},
                     0.5 * file.field->centre_circle_diameter,
                     file.field->penalty_area_length};
  constants.walk_limits = model.walk_limits();
  constants.actions = {name_of_action(model, Action::Kind::kKick, Side::kLeft),
                       name_of_action(model, Action::Kind::kKick, Side::kRight),
                       name_of_action(model, Action::Kind::kBlock),
                       name_of_action(model, Action::Kind::kDive, Side::kLeft),
                       name_of_action(model, Action::Kind::kDive, Side::kRight)};
  constants.parameters = PlayParameters::load(model.folder() / "play.yaml");
  const std::filesystem::path kick = model.folder() / kKickFile;
  if (!std::filesystem::exists(kick)) return constants;
  const YamlEntry root = YamlEntry::load(kick);
  const std::vector<double> ball = root.at("ball").numbers(2);
  const std::vector<double> reach = root.at("ball_reach").numbers(2);
  constants.kick = KickPlace{{ball[0], ball[1]}, {reach[0], reach[1]}};
  return constants;
}

}  // namespace nao::play
