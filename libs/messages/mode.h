#pragma once

#include "messages/enum_names.h"

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
inline const char* to_string(Mode mode) {
  static constexpr auto kNames =
      std::to_array<const char*>({"relaxed", "holding", "moving", "walking", "acting", "falling",
                                  "fallen", "getting-up", "no-robot"});
  static_assert(kNames.size() == kNumModes);
  return name_in(kNames, mode);
}

}  // namespace nao
