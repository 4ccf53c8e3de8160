#include "phone-gateway/server/core/motion_messages.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "common/joined.h"
#include "messages/command.h"

namespace nao::gateway {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
/** Keyframes of a motion; see remote.proto. */
constexpr int kMaxKeyframes = 200;
/** Characters of a motion's text; nao-motion-files takes no more. */
constexpr size_t kMaxTextBytes = 262144;
/** Length of a link's or posture's name. Chosen: longer than any. */
constexpr size_t kMaxNameLength = 64;
/** Distance of a dragged point and of its target from their frames' origins, m: longer than a
 * robot. */
constexpr double kMaxDragDistance = 2;

Refusal refuse_motion(Reason reason) {
  return {naoremote::INVALID_ARGUMENT, std::move(reason)};
}

bool has_joint(const naoremote::RobotDescription& robot, const std::string& name) {
  return std::any_of(robot.joints().begin(), robot.joints().end(),
                     [&](const naoremote::Joint& joint) { return joint.name() == name; });
}

/** Adds a keyframe; every list of the motion has an entry for each of its joints. */
std::optional<Reason> add_keyframe(const naoremote::Keyframe& from,
                                   const naoremote::RobotDescription& robot, NamedMotion& motion) {
  if (from.joint_names_size() != from.joint_position_size()) {
    return Reason("joint-lists-unequal", {std::to_string(from.joint_names_size()), "position",
                                          std::to_string(from.joint_position_size())});
  }
  NamedMotion::Keyframe keyframe{from.duration(), from.pause(), {}, {}};
  keyframe.position.assign(motion.joint_names.size(), kNan);
  for (int i = 0; i < from.joint_names_size(); ++i) {
    const std::string& name = from.joint_names(i);
    const double position = from.joint_position(i);
    if (!has_joint(robot, name)) return Reason("joint-unknown", {quoted(name)});
    if (!std::isfinite(position)) return Reason("joint-value-not-finite", {name, "position"});
    const auto known = std::find(motion.joint_names.begin(), motion.joint_names.end(), name);
    const auto index = static_cast<size_t>(known - motion.joint_names.begin());
    if (known == motion.joint_names.end()) {
      motion.joint_names.push_back(name);
      for (NamedMotion::Keyframe& earlier : motion.keyframes) earlier.position.push_back(kNan);
      keyframe.position.push_back(kNan);
    }
    if (!std::isnan(keyframe.position[index])) return Reason("joint-repeated", {name});
    keyframe.position[index] = position;
  }
  motion.keyframes.push_back(std::move(keyframe));
  return std::nullopt;
}

}  // namespace

naoremote::Motion to_protocol(const NamedMotion& motion) {
  naoremote::Motion result;
  result.set_name(motion.name);
  result.set_repetitions(static_cast<uint32_t>(std::max(1, motion.num_repetitions)));
  result.set_start(motion.start);
  for (const NamedMotion::Keyframe& from : motion.keyframes) {
    naoremote::Keyframe& keyframe = *result.add_keyframes();
    keyframe.set_duration(from.duration);
    keyframe.set_pause(from.pause);
    for (size_t i = 0; i < motion.joint_names.size() && i < from.position.size(); ++i) {
      if (std::isnan(from.position[i])) continue;
      keyframe.add_joint_names(motion.joint_names[i]);
      keyframe.add_joint_position(from.position[i]);
    }
  }
  return result;
}

std::variant<MotionFileCommand, Refusal> check(const naoremote::MotionFile& file,
                                               const naoremote::RobotDescription& robot) {
  MotionFileCommand command;
  if (!file.yaml().empty()) {
    if (file.yaml().size() > kMaxTextBytes) {
      return refuse_motion(Reason("motion-malformed", {"its text is too long"}));
    }
    command.yaml = file.yaml();
    return command;
  }
  const naoremote::Motion& motion = file.motion();
  if (motion.keyframes_size() < 1 || motion.keyframes_size() > kMaxKeyframes) {
    return refuse_motion(Reason("motion-keyframe-count", {std::to_string(motion.keyframes_size()),
                                                          std::to_string(kMaxKeyframes)}));
  }
  const bool is_posture =
      motion.start().empty() || std::find(robot.postures().begin(), robot.postures().end(),
                                          motion.start()) != robot.postures().end();
  if (!is_posture) {
    return refuse_motion(
        Reason("posture-unknown", {quoted(motion.start()), joined(robot.postures())}));
  }
  command.motion.name = motion.name();
  command.motion.start = motion.start();
  // A number that does not fit is out of range all the same.
  command.motion.num_repetitions =
      static_cast<int>(std::clamp<uint32_t>(motion.repetitions(), 1, 1000000));
  for (const naoremote::Keyframe& keyframe : motion.keyframes()) {
    if (auto fault = add_keyframe(keyframe, robot, command.motion)) {
      return refuse_motion(*std::move(fault));
    }
  }
  for (NamedMotion::Keyframe& keyframe : command.motion.keyframes) {
    keyframe.stiffness.assign(command.motion.joint_names.size(), kNan);
  }
  return command;
}

std::variant<DragCommand, Refusal> check(const naoremote::Drag& request) {
  const std::string& link = request.link();
  if (link.empty() || link.size() > kMaxNameLength) {
    return refuse_motion(gateway_reason("link-invalid"));
  }
  DragCommand command{link,
                      {request.point_x(), request.point_y(), request.point_z()},
                      {request.target_x(), request.target_y(), request.target_z()}};
  for (int i = 0; i < 3; ++i) {
    // Written so that NaN fails, too.
    const bool is_near = std::abs(command.point[i]) <= kMaxDragDistance / 2 &&
                         std::abs(command.target[i]) <= kMaxDragDistance;
    if (!is_near) {
      return refuse_motion(gateway_reason(
          "drag-out-of-range", {to_argument(kMaxDragDistance / 2), to_argument(kMaxDragDistance)}));
    }
  }
  return command;
}

}  // namespace nao::gateway
