#pragma once

#include <array>
#include <naolcm/play_command_t.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "messages/reason.h"

namespace nao {

/** Reason code of a play_state_t: a robot that plays by itself in a match has been driven by
 * a client and waits until it is released, by a play command with Behavior::kAuto. */
inline constexpr const char* kWaitsForRelease = "play-waits-for-release";

/** What the robot does by itself; the values are those of play_command_t::BEHAVIOR_*. */
enum class Behavior { kNone, kGoToBall, kKick, kDribble, kScore, kKeepGoal, kAuto };

/** The values are those of play_command_t::ROLE_*. */
enum class PlayRole { kNone, kStriker, kSupporter, kKeeper };

/** Progress of a behavior; the values are those of play_state_t::PHASE_*. */
enum class PlayPhase {
  kIdle,
  kSearch,
  kApproach,
  kAlign,
  kKick,
  kGuard,
  kBlock,
  kRecover,
  kDone,
};

/** Names for users, in the order of Behavior. */
inline constexpr std::array<std::string_view, 7> kBehaviorNames = {
    "none", "go-to-ball", "kick", "dribble", "score", "keep-goal", "auto"};
/** Names for users, in the order of PlayPhase. */
inline constexpr std::array<std::string_view, 9> kPlayPhaseNames = {
    "idle", "search", "approach", "align", "kick", "guard", "block", "recover", "done"};

/** @return Of kBehaviorNames; "unknown" for a value outside the enumeration. */
std::string_view to_string(Behavior behavior);

/** @return Of kPlayPhaseNames; "unknown" for a value outside the enumeration. */
std::string_view to_string(PlayPhase phase);

/** @return The behavior of a name of kBehaviorNames; nothing if there is none. */
std::optional<Behavior> find_behavior(std::string_view name);

/** Runs a behavior; play_command_t documents every field. */
struct PlayCommand {
  Behavior behavior = Behavior::kNone;
  PlayRole role = PlayRole::kNone;
  /** Point on the ground that the ball shall reach, m, in the odometry frame. */
  std::optional<std::array<double, 2>> target_in_odometry{};

  bool operator==(const PlayCommand&) const = default;
};

/** Checks every field.
 * @return Nothing, or the fault: "behavior-unknown", "role-unknown" or "target-out-of-range". */
[[nodiscard]] std::optional<Reason> check(const PlayCommand& command);

PlayCommand to_play_command(const naolcm::play_command_t& message);

/** The message without time, source and number. */
naolcm::play_command_t to_message(const PlayCommand& command);

}  // namespace nao
