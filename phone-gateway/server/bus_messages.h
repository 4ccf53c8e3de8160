#pragma once

#include <naolcm/image_t.hpp>
#include <naolcm/motion_state_t.hpp>
#include <naolcm/robot_state_t.hpp>
#include <string>
#include <unordered_map>
#include <vector>

#include "phone-gateway/server/image_cache.h"
#include "phone-gateway/server/robot_mirror.h"
#include "robot_model/robot_model.h"

namespace nao {

/** Turns robot_state_t into what phones get, with the joints in motor order. */
class RobotStateReader {
 public:
  explicit RobotStateReader(const naoremote::RobotDescription& robot);

  /** @throws Error  if a joint is missing, lists are of unequal length, or a number is not finite.
   */
  RobotSnapshot read(const naolcm::robot_state_t& message) const;

 private:
  std::unordered_map<std::string, int> motors_;
};

/** @throws Error  if a number that must be finite is not, or an enumeration has an unknown value.
 */
MotionSnapshot read_motion_state(const naolcm::motion_state_t& message);

/** @throws Error  if the message is no JPEG or has no size. */
StoredImage read_image(const naolcm::image_t& message);

}  // namespace nao
