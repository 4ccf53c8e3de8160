#pragma once

#include <naolcm/command_result_t.hpp>
#include <naolcm/image_t.hpp>
#include <naolcm/motion_state_t.hpp>
#include <naolcm/robot_state_t.hpp>
#include <string>
#include <vector>

#include "messages/command.h"
#include "phone-gateway/server/core/image_cache.h"
#include "phone-gateway/server/core/robot_mirror.h"

namespace nao::gateway {

/** Converts robot_state_t to the state that clients receive, with the joints in the order of the
 * robot's description. */
class RobotStateReader {
 public:
  explicit RobotStateReader(const naoremote::RobotDescription& robot);

  /** @throws Error  if a joint is unknown, repeated or missing, the lists have unequal lengths, or
   * a number is not finite. */
  RobotSnapshot read(const naolcm::robot_state_t& message) const;

 private:
  std::vector<std::string> joint_names_;
};

/** @throws Error  if a number that must be finite is not, or an enumeration has an unknown value.
 */
MotionSnapshot read_motion_state(const naolcm::motion_state_t& message);

/** @throws Error  if the image is no JPEG or has no size. */
CachedImage read_image(const naolcm::image_t& message);

/** @throws Error  if the kind or the status has an unknown value. */
CommandResult read_result(const naolcm::command_result_t& message);

}  // namespace nao::gateway
