#include "phone-gateway/server/core/request_check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "common/joined.h"

namespace nao::gateway {
namespace {

/** Fractions of the maximum speed where the client leaves it to the gateway; see remote.proto. */
constexpr double kDefaultPostureSpeed = 0.5;
constexpr double kDefaultJointSpeed = 0.3;
/** Largest change of a joint, rad: a little over 2 pi, more than the range of any joint. */
constexpr double kMaxJointChange = 6.3;
/** Largest distance of a goal or ball along each axis, m: about the length of a playing field. */
constexpr double kMaxDistance = 10;
/** Largest heading of a goal, rad: a little over pi, so that a rounded half turn passes. */
constexpr double kMaxHeading = 3.15;
/** Sizes that nao-head-camera renders, pixels; see camera_command_t. */
constexpr std::array<uint32_t, 3> kImageWidths = {640, 320, 160};
constexpr uint32_t kMaxQuality = 95;

/** False also for NaN. */
bool is_within(double value, double lower, double upper) {
  return value >= lower && value <= upper;
}

bool is_within(double value, double limit) {
  return is_within(value, -limit, limit);
}

template <class Values, class Value>
bool contains(const Values& values, const Value& value) {
  return std::find(values.begin(), values.end(), value) != values.end();
}

Refusal refuse_argument(GatewayReasonCode code, std::vector<std::string> arguments = {}) {
  return {naoremote::INVALID_ARGUMENT, gateway_reason(code, std::move(arguments))};
}

Refusal refuse_argument(Reason reason) {
  return {naoremote::INVALID_ARGUMENT, std::move(reason)};
}

/** A fraction of the maximum speed, with 0 replaced by the default. */
std::variant<double, Refusal> check_speed(double speed, double default_speed) {
  if (speed == 0) return default_speed;
  if (speed > 0 && speed <= 1) return speed;
  return refuse_argument(Reason("speed-out-of-range", {to_argument(speed)}));
}

/** nullptr if the robot has no such group. */
const naoremote::JointGroup* find_group(const naoremote::RobotDescription& robot,
                                        const std::string& name) {
  for (const naoremote::JointGroup& group : robot.joint_groups()) {
    if (group.name() == name) return &group;
  }
  return nullptr;
}

/** "right knee" for "left knee" and the other way round; the same name for a group without side. */
std::string mirrored_name(const std::string& name) {
  const std::string left = "left ";
  const std::string right = "right ";
  if (name.starts_with(left)) return right + name.substr(left.size());
  if (name.starts_with(right)) return left + name.substr(right.size());
  return name;
}

/** Adds a group's joints to a change. A joint that is listed already keeps its change: LHipYawPitch
 * belongs to both hips.
 * @param yaw_roll_sign  1, or -1 for the mirrored group: seen in a mirror in the xz plane,
 * rotations about x and z change sign, rotations about y do not. */
std::optional<Refusal> add_group(const naoremote::JointGroup& group,
                                 const naoremote::ChangeJoints& request, double yaw_roll_sign,
                                 JointChangeCommand& command) {
  struct Axis {
    const char* name;
    const std::string& joint;
    double change;
  };
  const std::array<Axis, 3> axes{{{"yaw", group.yaw_joint(), yaw_roll_sign * request.yaw()},
                                  {"pitch", group.pitch_joint(), request.pitch()},
                                  {"roll", group.roll_joint(), yaw_roll_sign * request.roll()}}};
  for (const Axis& axis : axes) {
    if (!is_within(axis.change, kMaxJointChange)) {
      return refuse_argument("joint-change-out-of-range",
                             {axis.name, to_argument(axis.change), to_argument(kMaxJointChange)});
    }
    // With a stiffness all joints of the group are meant.
    const bool is_meant = axis.change != 0 || (request.has_stiffness() && !axis.joint.empty());
    if (!is_meant) continue;
    if (axis.joint.empty()) return refuse_argument("axis-missing", {group.name(), axis.name});
    if (contains(command.joint_names, axis.joint)) continue;
    command.joint_names.push_back(axis.joint);
    command.joint_position.push_back(axis.change);
  }
  return std::nullopt;
}

}  // namespace

std::variant<WalkCommand, Refusal> check(const naoremote::WalkTurn& request,
                                         const naoremote::RobotDescription& robot) {
  if (!std::isfinite(request.vx()) || !std::isfinite(request.vy()) ||
      !std::isfinite(request.wz())) {
    return refuse_argument(Reason("velocity-not-finite"));
  }
  return WalkCommand{std::clamp(request.vx(), robot.min_vx(), robot.max_vx()),
                     std::clamp(request.vy(), -robot.max_vy(), robot.max_vy()),
                     std::clamp(request.wz(), -robot.max_wz(), robot.max_wz())};
}

std::variant<MoveToCommand, Refusal> check(const naoremote::MoveTo& request) {
  if (!is_within(request.x(), kMaxDistance) || !is_within(request.y(), kMaxDistance) ||
      !is_within(request.theta(), kMaxHeading)) {
    return refuse_argument("goal-out-of-range",
                           {to_argument(kMaxDistance), to_argument(kMaxHeading)});
  }
  return MoveToCommand{request.x(), request.y(), request.theta()};
}

std::variant<PostureCommand, Refusal> check(const naoremote::GoToPosture& request,
                                            const naoremote::RobotDescription& robot) {
  if (!contains(robot.postures(), request.posture())) {
    return refuse_argument(
        Reason("posture-unknown", {quoted(request.posture()), joined(robot.postures())}));
  }
  auto speed = check_speed(request.speed(), kDefaultPostureSpeed);
  if (auto* refusal = std::get_if<Refusal>(&speed)) return std::move(*refusal);
  return PostureCommand{request.posture(), std::get<double>(speed)};
}

std::variant<JointChangeCommand, Refusal> check(const naoremote::ChangeJoints& request,
                                                const naoremote::RobotDescription& robot) {
  const naoremote::JointGroup* group = find_group(robot, request.group());
  if (group == nullptr) {
    return refuse_argument(
        "joint-group-unknown",
        {quoted(request.group()), joined(robot.joint_groups(), &naoremote::JointGroup::name)});
  }
  auto speed = check_speed(request.speed(), kDefaultJointSpeed);
  if (auto* refusal = std::get_if<Refusal>(&speed)) return std::move(*refusal);
  JointChangeCommand command;
  command.is_relative = true;
  command.speed = std::get<double>(speed);
  command.allow_tipping = request.allow_tipping();
  if (request.has_stiffness() && !is_within(request.stiffness(), 0, 1)) {
    return refuse_argument("stiffness-out-of-range", {to_argument(request.stiffness())});
  }
  if (auto refusal = add_group(*group, request, 1, command)) return *std::move(refusal);
  if (request.both_sides()) {
    const naoremote::JointGroup* other = find_group(robot, mirrored_name(group->name()));
    if (other != nullptr && other != group) {
      if (auto refusal = add_group(*other, request, -1, command)) return *std::move(refusal);
    }
  }
  if (command.joint_names.empty()) return refuse_argument("joint-change-zero");
  if (request.has_stiffness()) {
    command.joint_stiffness.assign(command.joint_names.size(), request.stiffness());
  }
  return command;
}

std::variant<ActionCommand, Refusal> check(const naoremote::DoAction& request,
                                           const naoremote::RobotDescription& robot) {
  if (!contains(robot.actions(), request.action())) {
    return refuse_argument(
        Reason("action-unknown", {quoted(request.action()), joined(robot.actions())}));
  }
  constexpr double kAbsent = std::numeric_limits<double>::quiet_NaN();
  ActionCommand command{request.action(), kAbsent, kAbsent, kAbsent};
  if (request.has_ball_x() != request.has_ball_y()) return refuse_argument("ball-incomplete");
  if (request.has_ball_x()) {
    if (!is_within(request.ball_x(), kMaxDistance) || !is_within(request.ball_y(), kMaxDistance)) {
      return refuse_argument("ball-out-of-range", {to_argument(kMaxDistance)});
    }
    command.ball_x = request.ball_x();
    command.ball_y = request.ball_y();
  }
  if (request.has_strength()) {
    if (!(request.strength() > 0 && request.strength() <= 1)) {
      return refuse_argument(Reason("strength-out-of-range", {to_argument(request.strength())}));
    }
    command.strength = request.strength();
  }
  return command;
}

std::variant<SpeechCommand, Refusal> check(const naoremote::Say& request) {
  SpeechCommand command;
  command.operation = static_cast<SpeechCommand::Operation>(request.operation());
  command.text = request.text();
  command.language = request.language();
  if (request.has_volume()) command.volume = request.volume();
  if (request.rate() != 0) command.rate = request.rate();
  if (auto fault = nao::check(command)) return refuse_argument(*std::move(fault));
  return command;
}

std::variant<LightCommand, Refusal> check(const naoremote::SetLights& request,
                                          const naoremote::RobotDescription& robot) {
  if (request.light_names_size() != request.light_rgb_size()) {
    return refuse_argument("light-lists-unequal", {std::to_string(request.light_names_size()),
                                                   std::to_string(request.light_rgb_size())});
  }
  LightCommand command;
  command.duration = request.duration();
  for (int i = 0; i < request.light_names_size(); ++i) {
    const uint32_t rgb = request.light_rgb(i);
    // Part by part; what is above 0xffffff makes red larger than 1.
    command.light_names.push_back(request.light_names(i));
    command.light_rgb.push_back(
        {(rgb >> 16) / 255.0, (rgb >> 8 & 0xff) / 255.0, (rgb & 0xff) / 255.0});
  }
  std::vector<std::string> known_names;
  for (const naoremote::Light& light : robot.lights()) known_names.push_back(light.name());
  if (auto fault = nao::check(command, known_names)) return refuse_argument(*std::move(fault));
  return command;
}

std::variant<PlayCommand, Refusal> check(const naoremote::Play& request) {
  PlayCommand command;
  command.behavior = static_cast<Behavior>(request.behavior());
  if (request.has_target_x() != request.has_target_y())
    return refuse_argument("target-incomplete", {});
  if (request.has_target_x()) command.target_in_odometry = {request.target_x(), request.target_y()};
  if (auto fault = nao::check(command)) {
    return Refusal{naoremote::INVALID_ARGUMENT, *std::move(fault)};
  }
  return command;
}

std::variant<ImageSelection, Refusal> check(const naoremote::ImageRequest& request,
                                            const naoremote::RobotDescription& robot) {
  ImageSelection selection;
  selection.camera = request.camera();
  if (selection.camera.empty() && !robot.cameras().empty()) selection.camera = robot.cameras(0);
  // A robot without cameras still accepts the empty name, so that its states can be subscribed to.
  if (!request.camera().empty() && !contains(robot.cameras(), request.camera())) {
    return refuse_argument("camera-unknown", {quoted(request.camera()), joined(robot.cameras())});
  }
  if (request.width() != 0) selection.width = request.width();
  if (!contains(kImageWidths, selection.width)) {
    return refuse_argument("width-unsupported", {std::to_string(selection.width)});
  }
  selection.quality = request.quality();
  if (selection.quality > kMaxQuality) {
    return refuse_argument("quality-out-of-range", {std::to_string(selection.quality)});
  }
  return selection;
}

std::variant<Subscription, Refusal> check(const naoremote::Subscribe& request,
                                          const naoremote::RobotDescription& robot,
                                          const GatewayLimits& limits) {
  if (!is_within(request.state_rate(), 0, limits.max_state_rate)) {
    return refuse_argument("state-rate-out-of-range",
                           {to_argument(request.state_rate()), to_argument(limits.max_state_rate)});
  }
  if (!is_within(request.image_rate(), 0, limits.max_image_rate)) {
    return refuse_argument("image-rate-out-of-range",
                           {to_argument(request.image_rate()), to_argument(limits.max_image_rate)});
  }
  auto image = check(request.image(), robot);
  if (auto* refusal = std::get_if<Refusal>(&image)) return std::move(*refusal);
  return Subscription{
      request.state_rate(), request.image_rate(), std::get<ImageSelection>(std::move(image)),
      request.audio(),      request.play_state(), request.vision()};
}

}  // namespace nao::gateway
