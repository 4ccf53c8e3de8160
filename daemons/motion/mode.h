#pragma once

namespace nao::motion {

/** What the robot is doing, as motion_state_t names it. */
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

/** Name as in motion_state_t: "getting-up". */
const char* to_string(Mode mode);

}  // namespace nao::motion
