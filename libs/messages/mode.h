#pragma once

namespace nao {

/** Mode of nao-motion; the values are those of motion_state_t::MODE_*. */
enum class Mode {
  kRelaxed,
  kHolding,
  kMoving,
  kWalking,
  kActing,
  kFalling,
  kFallen,
  kGettingUp,
  kNoRobot,
};

inline constexpr int kNumModes = 9;

/** Name for logs and users: "getting-up"; "unknown" for a value outside the enumeration. */
const char* to_string(Mode mode);

}  // namespace nao
