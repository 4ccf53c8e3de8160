#pragma once

#include <string>
#include <variant>

#include "messages/motion_file.h"
#include "phone-gateway/server/core/gateway_reasons.h"
#include "remote.pb.h"

namespace nao::gateway {

/** A motion as clients get it: each keyframe with the joints that it moves. */
naoremote::Motion to_protocol(const NamedMotion& motion);

/** Checks the form of a client's motion: its joints exist, each keyframe's lists are of equal
 * length, and there are not too many keyframes. What it makes the robot do, nao-motion-files
 * checks.
 * @return A command without operation. */
[[nodiscard]] std::variant<MotionFileCommand, Refusal> check(
    const naoremote::MotionFile& file, const naoremote::RobotDescription& robot);

/** A link that is pulled to a point. */
struct DragCommand {
  std::string link;
  /** m, in the link's frame, and in the torso's. */
  double point[3] = {};
  double target[3] = {};
};

[[nodiscard]] std::variant<DragCommand, Refusal> check(const naoremote::Drag& request);

}  // namespace nao::gateway
