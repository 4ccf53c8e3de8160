#include "inspection/foxglove_messages.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "kinematics/odometry_alignment.h"
#include "message_reflection/message_layout.h"

namespace nao {
namespace {

constexpr SceneColor kYellow{1, 0.8, 0.1, 1};
constexpr SceneColor kRed{0.9, 0.2, 0.2, 1};
constexpr SceneColor kGreen{0.2, 0.8, 0.3, 1};
constexpr SceneColor kBlue{0.2, 0.5, 1, 1};
constexpr SceneColor kWhite{1, 1, 1, 1};

// Chosen to be visible beside the robot without covering it, m.
constexpr double kPointDiameter = 0.02;
// Length of a force's arrow, m/N: a robot of 5 kg on two feet has arrows of some centimetres.
constexpr double kForceScale = 0.002;
// Contacts below this force are not drawn, N: arrows shorter than their head.
constexpr double kLeastForce = 5;
// data/scenes/soccer.yaml, m.
constexpr double kBallDiameter = 0.1;

Eigen::Vector3d on_ground(const double* xy) {
  return {xy[0], xy[1], 0};
}

bool is_finite(const double* xy) {
  return std::isfinite(xy[0]) && std::isfinite(xy[1]);
}

void add_if_finite(JsonWriter& json, const char* key, double value) {
  if (std::isfinite(value)) json.add(key, value);
}

/** "goal post" for detection_t's KIND_GOAL_POST. */
std::string name_of_kind(int8_t kind) {
  static const FieldLayout& field = find_message_layout("detection_t")->fields.front();
  const std::string* constant = find_constant_name(field, kind);
  if (constant == nullptr) return std::to_string(kind);
  std::string name = constant->substr(field.name.size() + 1);
  std::transform(name.begin(), name.end(), name.begin(), [](unsigned char letter) {
    return letter == '_' ? ' ' : static_cast<char>(std::tolower(letter));
  });
  return name;
}

}  // namespace

Eigen::Isometry3d to_pose(const double* position, const double* orientation) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() << position[0], position[1], position[2];
  const Eigen::Quaterniond q(orientation[0], orientation[1], orientation[2], orientation[3]);
  pose.linear() = q.normalized().toRotationMatrix();
  return pose;
}

std::string joint_states_json(const naolcm::sensor_state_t& state) {
  JsonWriter json;
  json.begin_object();
  add_time(json, "timestamp", state.utime);
  json.begin_array("joints");
  for (size_t i = 0; i < state.joint_names.size(); ++i) {
    json.begin_object();
    json.add("name", state.joint_names[i]);
    add_if_finite(json, "position", state.joint_position[i]);
    add_if_finite(json, "velocity", state.joint_velocity[i]);
    add_if_finite(json, "effort", state.joint_torque[i]);
    json.end();
  }
  return json.take();
}

std::string odometry_json(const naolcm::robot_state_t& state, const std::string& root) {
  const Eigen::Isometry3d pose =
      to_pose(state.position_torso_in_odometry, state.orientation_torso_in_odometry);
  const Eigen::Matrix3d heading_in_torso =
      pose.linear().transpose() * projected_on_ground(pose).linear();
  JsonWriter json;
  json.begin_object();
  add_time(json, "timestamp", state.utime);
  json.add("frame_id", kOdometryFrame);
  json.add("body_frame_id", root);
  add_pose(json, "pose", pose);
  add_vector(json, "linear_velocity",
             heading_in_torso * Eigen::Vector3d(state.velocity_torso_in_heading));
  add_vector(json, "angular_velocity", Eigen::Vector3d(state.angular_velocity_torso));
  return json.take();
}

std::string compressed_image_json(const naolcm::image_t& image, const std::string& frame) {
  JsonWriter json;
  json.begin_object();
  add_time(json, "timestamp", image.utime);
  json.add("frame_id", frame);
  json.add_base64("data", image.data);
  json.add("format", image.format);
  return json.take();
}

std::string camera_calibration_json(const naolcm::image_t& image, const std::string& frame) {
  const std::array<double, 9> intrinsics{image.fx, 0, image.cx, 0, image.fy, image.cy, 0, 0, 1};
  const std::array<double, 9> rectification{1, 0, 0, 0, 1, 0, 0, 0, 1};
  const std::array<double, 12> projection{image.fx, 0, image.cx, 0, 0, image.fy,
                                          image.cy, 0, 0,        0, 1, 0};
  JsonWriter json;
  json.begin_object();
  add_time(json, "timestamp", image.utime);
  json.add("frame_id", frame);
  json.add("width", image.width);
  json.add("height", image.height);
  // k1, k2, p1, p2, k3, as image_t has them.
  json.add("distortion_model", "plumb_bob");
  json.add("D", image.distortion, 5);
  json.add("K", intrinsics.data(), intrinsics.size());
  json.add("R", rectification.data(), rectification.size());
  json.add("P", projection.data(), projection.size());
  return json.take();
}

std::vector<SceneEntity> balance_entities(const naolcm::robot_state_t& state) {
  SceneEntity entity;
  entity.frame = kOdometryFrame;
  entity.id = "balance";
  const Eigen::Vector3d com(state.center_of_mass_in_odometry);
  const Eigen::Vector3d below(com.x(), com.y(), 0);
  entity.spheres.push_back({com, 2 * kPointDiameter, kYellow});
  entity.spheres.push_back({below, kPointDiameter, kYellow});
  entity.lines.push_back({{com, below}, kYellow, false});
  if (is_finite(state.center_of_pressure_in_odometry)) {
    entity.spheres.push_back(
        {on_ground(state.center_of_pressure_in_odometry), kPointDiameter, kRed});
  }
  SceneEntity::Line support{{}, kGreen, true};
  for (const auto& corner : state.support_corner_in_odometry) {
    support.points.push_back(on_ground(corner.data()));
  }
  if (!support.points.empty()) entity.lines.push_back(std::move(support));
  return {std::move(entity)};
}

std::vector<SceneEntity> footstep_entities(const naolcm::motion_state_t& state,
                                           const RobotModel& model) {
  SceneEntity entity;
  entity.frame = kOdometryFrame;
  entity.id = "footsteps";
  for (const naolcm::footstep_t& step : state.footsteps) {
    const bool is_left = step.is_left != 0;
    const Eigen::Isometry3d pose =
        Eigen::Translation3d(on_ground(step.position_in_odometry)) *
        Eigen::AngleAxisd(step.heading_in_odometry, Eigen::Vector3d::UnitZ());
    SceneEntity::Line outline{{}, is_left ? kRed : kGreen, true};
    for (const Eigen::Vector2d& corner :
         is_left ? model.left_sole_outline() : model.right_sole_outline()) {
      outline.points.push_back(pose * Eigen::Vector3d(corner.x(), corner.y(), 0));
    }
    entity.lines.push_back(std::move(outline));
  }
  return {std::move(entity)};
}

std::vector<SceneEntity> detection_entities(const naolcm::vision_state_t& state) {
  SceneEntity detections;
  detections.frame = kHeadingFrame;
  detections.id = "detections";
  for (const naolcm::detection_t& detection : state.detections) {
    if (!is_finite(detection.position_in_heading)) continue;
    const Eigen::Vector3d position = on_ground(detection.position_in_heading);
    if (detection.kind == naolcm::detection_t::KIND_LINE && is_finite(detection.end_in_heading)) {
      detections.lines.push_back({{position, on_ground(detection.end_in_heading)}, kWhite, false});
    } else {
      detections.spheres.push_back({position, kPointDiameter, kBlue});
      detections.texts.push_back({position, name_of_kind(detection.kind), kWhite});
    }
  }
  SceneEntity ball;
  ball.frame = kOdometryFrame;
  ball.id = "ball";
  if (state.has_ball != 0) {
    const Eigen::Vector3d center =
        on_ground(state.ball_position_in_odometry) + Eigen::Vector3d::UnitZ() * (kBallDiameter / 2);
    ball.spheres.push_back({center, kBallDiameter, kBlue});
    ball.arrows.push_back({center, on_ground(state.ball_velocity_in_odometry), kBlue});
  }
  return {std::move(detections), std::move(ball)};
}

std::vector<SceneEntity> world_entities(const naolcm::world_truth_t& truth) {
  SceneEntity entity;
  entity.frame = kWorldFrame;
  entity.id = "world";
  if (truth.has_ball != 0) {
    entity.spheres.push_back(
        {Eigen::Vector3d(truth.position_ball_in_world), kBallDiameter, kWhite});
  }
  for (const naolcm::contact_t& contact : truth.contacts) {
    const Eigen::Vector3d force(contact.force_on_a_in_world);
    if (force.norm() < kLeastForce) continue;
    entity.arrows.push_back(
        {Eigen::Vector3d(contact.position_in_world), kForceScale * force, kRed});
  }
  return {std::move(entity)};
}

}  // namespace nao
