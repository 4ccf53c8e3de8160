#pragma once

#include <array>

#include "daemons/robot/safety.h"

namespace nao::robot {

/** State that the eyes show. */
enum class EyeState { kNoClient, kReady, kDriver, kLinkLost, kFault };

/** @param has_driver  A client drives the robot. @param fault  Present fault. */
inline EyeState eye_state(const Safety& safety, bool has_driver, Fault fault) {
  if (fault != Fault::kNone) return EyeState::kFault;
  if (safety.cause() == Cause::kLinkLost && safety.phase() != Phase::kDriven &&
      safety.phase() != Phase::kStiffening) {
    return EyeState::kLinkLost;
  }
  if (!safety.has_controller()) return EyeState::kNoClient;
  return has_driver ? EyeState::kDriver : EyeState::kReady;
}

/** Red, green, blue, 0 to 1. Chosen: red and yellow warn, as usual; people who confuse red and
 * green can distinguish blue from green. */
inline std::array<double, 3> eye_color(EyeState state) {
  switch (state) {
    case EyeState::kNoClient:
      return {0.3, 0.3, 0.3};
    case EyeState::kReady:
      return {0, 0, 1};
    case EyeState::kDriver:
      return {0, 1, 0};
    case EyeState::kLinkLost:
      return {1, 0.6, 0};
    default:
      return {1, 0, 0};
  }
}

/** Color of the chest light, which is in the button: it shows what a press would change. */
inline std::array<double, 3> chest_color(Phase phase) {
  switch (phase) {
    case Phase::kStiffening:
    case Phase::kSitting:
      return {1, 0.6, 0};
    case Phase::kDriven:
      return {0, 1, 0};
    default:
      return {0, 0, 1};
  }
}

}  // namespace nao::robot
