#pragma once

#include <array>
#include <string_view>

namespace nao {

/** Names of Action::Kind: those of robot.yaml, then two that no file has. */
inline constexpr auto kActionKinds = std::to_array<std::string_view>(
    {"stand-up", "rest", "kick", "block", "dive", "gesture", "policy", "own-gait"});

}  // namespace nao
