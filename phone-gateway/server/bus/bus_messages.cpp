#include "phone-gateway/server/bus/bus_messages.h"

#include <algorithm>
#include <cmath>

#include "common/error.h"
#include "messages/body_condition.h"
#include "messages/mode.h"
#include "messages/named_joints.h"

namespace nao::gateway {
namespace {

/** Bounds of a piece of audio: a ServerMessage is below 100 kB, and browsers play 8000 to 96000
 * samples a second (Web Audio API, createBuffer). */
constexpr int kMaxAudioBytes = 65536;
constexpr int kMinSampleRate = 8000;
constexpr int kMaxSampleRate = 96000;

/** Images whose size is remembered: some seconds of two cameras. */
constexpr size_t kMaxImageSizes = 128;
/** Objects of one image that clients receive: the message stays short for a phone. */
constexpr size_t kMaxDetections = 200;

double finite(double value, const char* field) {
  if (!std::isfinite(value)) throw MessageError(std::string(field) + " is not finite");
  return value;
}

Mode read_mode(int8_t mode) {
  if (mode < 0 || mode >= kNumModes) throw MessageError("unknown mode " + std::to_string(mode));
  return static_cast<Mode>(mode);
}

/** The protocol's enumeration begins with NONE = 0, that of motion_state_t with NONE = -1. */
naoremote::CommandKind read_activity_kind(int8_t kind) {
  static_assert(naolcm::motion_state_t::COMMAND_KIND_NONE + 1 == naoremote::COMMAND_KIND_NONE);
  static_assert(naolcm::motion_state_t::COMMAND_KIND_STOP + 1 == naoremote::COMMAND_KIND_STOP);
  if (!naoremote::CommandKind_IsValid(kind + 1)) {
    throw MessageError("unknown command kind " + std::to_string(kind));
  }
  return static_cast<naoremote::CommandKind>(kind + 1);
}

/** xx, xy, yy of a covariance; nothing if a number is not finite. */
template <class Matrix, class Message>
void write_covariance(const Matrix& covariance, Message& message) {
  const double parts[] = {covariance[0][0], covariance[0][1], covariance[1][1]};
  for (const double part : parts) {
    if (!std::isfinite(part)) return;
  }
  for (const double part : parts) message.add_covariance(static_cast<float>(part));
}

void write_positions(const naolcm::detection_t& seen, naoremote::Vision::Detection& detection) {
  const auto& from = seen.position_in_heading;
  const auto& to = seen.end_in_heading;
  if (!std::isfinite(from[0]) || !std::isfinite(from[1])) return;
  for (const double part : from) detection.add_position(static_cast<float>(part));
  if (seen.kind == naolcm::detection_t::KIND_LINE && std::isfinite(to[0]) && std::isfinite(to[1])) {
    for (const double part : to) detection.add_position(static_cast<float>(part));
  }
  write_covariance(seen.covariance, detection);
}

void write_ball(const naolcm::vision_state_t& message, naoremote::Vision::Ball& ball) {
  ball.set_x(static_cast<float>(finite(message.ball_position_in_odometry[0], "ball_position")));
  ball.set_y(static_cast<float>(finite(message.ball_position_in_odometry[1], "ball_position")));
  ball.set_vx(static_cast<float>(finite(message.ball_velocity_in_odometry[0], "ball_velocity")));
  ball.set_vy(static_cast<float>(finite(message.ball_velocity_in_odometry[1], "ball_velocity")));
  write_covariance(message.ball_covariance, ball);
  ball.set_age(static_cast<float>(1e-6 * static_cast<double>(message.utime - message.ball_utime)));
  ball.set_is_rolling(message.is_ball_rolling != 0);
}

void write_field_pose(const naolcm::vision_state_t& message, naoremote::Vision::FieldPose& pose) {
  pose.set_x(static_cast<float>(finite(message.torso_in_field[0], "torso_in_field")));
  pose.set_y(static_cast<float>(finite(message.torso_in_field[1], "torso_in_field")));
  pose.set_theta(static_cast<float>(finite(message.torso_in_field[2], "torso_in_field")));
  write_covariance(message.field_pose_covariance, pose);
  if (pose.covariance_size() == 3) {
    pose.add_covariance(static_cast<float>(message.field_pose_covariance[2][2]));
  }
}

}  // namespace

RobotStateReader::RobotStateReader(const naoremote::RobotDescription& robot) {
  for (const naoremote::Joint& joint : robot.joints()) joint_names_.push_back(joint.name());
}

RobotSnapshot RobotStateReader::read(const naolcm::robot_state_t& message) const {
  RobotSnapshot robot;
  robot.utime = message.utime;
  if (const auto fault =
          read_named_joints(joint_names_, message.joint_names,
                            {{"position", message.joint_position, robot.joint_position}})) {
    throw MessageError(to_sentence(*fault));
  }
  for (size_t i = 0; i < robot.torso_orientation.size(); ++i) {
    robot.torso_orientation[i] =
        finite(message.orientation_torso_in_odometry[i], "orientation_torso_in_odometry");
  }
  for (size_t i = 0; i < robot.torso_position.size(); ++i) {
    robot.torso_position[i] =
        finite(message.position_torso_in_odometry[i], "position_torso_in_odometry");
  }
  return robot;
}

MotionSnapshot read_motion_state(const naolcm::motion_state_t& message) {
  MotionSnapshot motion;
  motion.mode = read_mode(message.mode);
  motion.posture = message.posture;
  const naoremote::CommandKind kind = read_activity_kind(message.command_kind);
  const bool has_activity = kind != naoremote::COMMAND_KIND_NONE || !message.command_name.empty() ||
                            message.needs_help != 0;
  if (has_activity) {
    naoremote::Activity& activity = motion.activity.emplace();
    activity.set_kind(kind);
    activity.set_name(message.command_name);
    activity.set_needs_help(message.needs_help != 0);
  }
  motion.progress = std::isfinite(message.command_progress) ? message.command_progress : -1;
  motion.velocity = {finite(message.vx, "vx"), finite(message.vy, "vy"), finite(message.wz, "wz")};
  motion.stiffness = finite(message.stiffness, "stiffness");
  return motion;
}

CachedImage read_image(const naolcm::image_t& message) {
  if (message.format != "jpeg") throw MessageError("an image of format " + quoted(message.format));
  if (message.width <= 0 || message.height <= 0) throw MessageError("an image without size");
  CachedImage image;
  image.utime = message.utime;
  image.camera = message.camera;
  image.width = static_cast<uint32_t>(message.width);
  image.height = static_cast<uint32_t>(message.height);
  image.jpeg.assign(message.data.begin(), message.data.end());
  return image;
}

std::vector<uint32_t> read_lights(const naolcm::body_state_t& message,
                                  const naoremote::RobotDescription& robot) {
  std::vector<uint32_t> light_rgb;
  for (const naoremote::Light& light : robot.lights()) {
    uint32_t color = 0;
    for (size_t i = 0; i < message.light_names.size(); ++i) {
      if (message.light_names[i] != light.name()) continue;
      for (const double part : message.light_rgb[i]) {
        if (!(part >= 0 && part <= 1)) throw MessageError("the color of the light " + light.name());
        color = color << 8 | static_cast<uint32_t>(std::lround(255 * part));
      }
    }
    light_rgb.push_back(color);
  }
  return light_rgb;
}

std::optional<naoremote::Body> read_body(const naolcm::body_state_t& message,
                                         const naoremote::RobotDescription& robot) {
  const BodyCondition condition = summarize(message);
  if (!condition.is_known()) return std::nullopt;
  const auto has_joint = [&robot](const std::string& name) {
    return std::any_of(robot.joints().begin(), robot.joints().end(),
                       [&](const auto& joint) { return joint.name() == name; });
  };
  naoremote::Body body;
  if (condition.battery_charge) {
    body.set_battery_charge(static_cast<float>(*condition.battery_charge));
  }
  body.set_is_charging(condition.is_charging);
  if (has_joint(condition.hottest_joint)) {
    body.set_hottest_joint(condition.hottest_joint);
    body.set_hottest_temperature(static_cast<float>(condition.hottest_temperature));
  }
  for (const std::string& code : condition.warnings) body.add_warnings(code);
  for (const std::string& joint : condition.faulty_joints) {
    if (has_joint(joint)) body.add_faulty_joints(joint);
  }
  return body;
}

SpeechPiece read_audio(const naolcm::speech_audio_t& message) {
  if (message.format != "s16le") throw MessageError("audio of format " + quoted(message.format));
  if (message.size_bytes % 2 != 0 || message.size_bytes > kMaxAudioBytes) {
    throw MessageError("a piece of audio of " + std::to_string(message.size_bytes) + " bytes");
  }
  if (message.sample_rate < kMinSampleRate || message.sample_rate > kMaxSampleRate ||
      message.first_sample < 0) {
    throw MessageError("audio of " + std::to_string(message.sample_rate) + " samples a second");
  }
  return {message.source,
          message.command_id,
          static_cast<uint32_t>(message.sample_rate),
          static_cast<uint64_t>(message.first_sample),
          message.is_last != 0,
          {message.data.begin(), message.data.end()}};
}

void ImageSizes::add(const naolcm::image_t& image) {
  const Size size{static_cast<double>(image.width), static_cast<double>(image.height)};
  for (Entry& entry : entries_) {
    if (entry.camera != image.camera || entry.utime != image.utime) continue;
    if (size.width > entry.size.width) entry.size = size;
    return;
  }
  entries_.push_back({image.camera, image.utime, size});
  if (entries_.size() > kMaxImageSizes) entries_.pop_front();
}

ImageSizes::Size ImageSizes::find(const std::string& camera, int64_t utime) const {
  Size last;
  for (const Entry& entry : entries_) {
    if (entry.camera != camera) continue;
    last = entry.size;
    if (entry.utime == utime) break;
  }
  return last;
}

naoremote::Vision read_vision(const naolcm::vision_state_t& message, const ImageSizes& sizes) {
  using naoremote::Vision;
  if (!Vision::ImageStatus_IsValid(message.image_status)) {
    throw MessageError("unknown image status " + std::to_string(message.image_status));
  }
  Vision vision;
  vision.set_utime(static_cast<uint64_t>(message.utime));
  vision.set_camera(message.camera);
  vision.set_image_status(static_cast<Vision::ImageStatus>(message.image_status));
  const ImageSizes::Size size = sizes.find(message.camera, message.utime);
  for (const naolcm::detection_t& seen : message.detections) {
    if (vision.detections_size() >= static_cast<int>(kMaxDetections)) break;
    if (!Vision::Detection::Kind_IsValid(seen.kind)) {
      throw MessageError("unknown kind of object " + std::to_string(seen.kind));
    }
    Vision::Detection& detection = *vision.add_detections();
    detection.set_kind(static_cast<Vision::Detection::Kind>(seen.kind));
    for (int i = 0; i < 4; ++i) {
      const double length = i % 2 == 0 ? size.width : size.height;
      detection.add_box(static_cast<float>(finite(seen.box_px[i], "box_px") / length));
      // NaN: not a line.
      if (std::isfinite(seen.line_px[i])) {
        detection.add_line(static_cast<float>(seen.line_px[i] / length));
      }
    }
    if (detection.line_size() != 4) detection.clear_line();
    write_positions(seen, detection);
    detection.set_confidence(static_cast<float>(finite(seen.confidence, "confidence")));
  }
  if (message.has_ball != 0) write_ball(message, *vision.mutable_ball());
  if (message.has_field_pose != 0) write_field_pose(message, *vision.mutable_field_pose());
  return vision;
}

naoremote::PlayState read_play_state(const naolcm::play_state_t& message) {
  if (!naoremote::PlayState::Phase_IsValid(message.phase)) {
    throw MessageError("unknown phase " + std::to_string(message.phase));
  }
  naoremote::PlayState state;
  state.set_utime(static_cast<uint64_t>(message.utime));
  state.set_plays_match(message.behavior == naolcm::play_state_t::BEHAVIOR_AUTO);
  // A behavior that clients cannot command, as in a match, is none to them.
  if (naoremote::Play::Behavior_IsValid(message.behavior)) {
    state.set_behavior(static_cast<naoremote::Play::Behavior>(message.behavior));
  }
  state.set_phase(static_cast<naoremote::PlayState::Phase>(message.phase));
  if (std::isfinite(message.target_in_field[0]) && std::isfinite(message.target_in_field[1])) {
    state.set_target_x(static_cast<float>(message.target_in_field[0]));
    state.set_target_y(static_cast<float>(message.target_in_field[1]));
  }
  state.set_reason_code(message.reason_code);
  state.set_reason(message.reason);
  return state;
}

std::vector<PlayerLabel> read_players(const MatchState& state) {
  std::vector<PlayerLabel> players;
  for (const MatchPlayer& player : state.players) {
    players.push_back(
        {player.robot, static_cast<uint32_t>(player.team), static_cast<uint32_t>(player.number)});
  }
  return players;
}

naoremote::Match read_match(const MatchState& state) {
  naoremote::Match match;
  match.set_phase(static_cast<naoremote::Match::Phase>(state.phase));
  match.set_half(static_cast<uint32_t>(state.half));
  match.set_time_left(static_cast<uint32_t>(std::ceil(state.time_left)));
  match.set_score_0(static_cast<uint32_t>(state.score[0]));
  match.set_score_1(static_cast<uint32_t>(state.score[1]));
  match.set_event_id(static_cast<uint64_t>(state.event.id));
  match.set_event(static_cast<naoremote::Match::Event>(state.event.kind));
  if (state.event.team >= 0) match.set_event_team(static_cast<uint32_t>(state.event.team));
  match.set_event_robot(state.event.robot);
  for (const MatchPlayer& player : state.players) {
    if (player.penalty == Penalty::kNone) continue;
    naoremote::Match::Penalty& penalty = *match.add_penalties();
    penalty.set_robot(player.robot);
    penalty.set_time_left(
        static_cast<uint32_t>(std::ceil(std::clamp(player.penalty_left, 0.0, 1e6))));
  }
  return match;
}

CommandResult read_result(const naolcm::command_result_t& message) {
  if (message.command_kind < 0 || message.command_kind > static_cast<int>(CommandKind::kLight)) {
    throw MessageError("unknown command kind " + std::to_string(message.command_kind));
  }
  if (message.status < message.STATUS_ACCEPTED || message.status > message.STATUS_FAILED) {
    throw MessageError("unknown result status " + std::to_string(message.status));
  }
  CommandResult result;
  result.source = message.source;
  result.id = message.command_id;
  result.kind = static_cast<CommandKind>(message.command_kind);
  result.status = static_cast<ResultStatus>(message.status);
  result.reason.code = message.reason_code;
  result.reason.arguments = message.reason_arguments;
  result.sentence = message.reason;
  return result;
}

}  // namespace nao::gateway
