#include "messages/play_command.h"

#include <algorithm>
#include <cmath>
#include <naolcm/play_state_t.hpp>

#include "messages/enum_names.h"

namespace nao {
namespace {

using naolcm::play_command_t;
using naolcm::play_state_t;

static_assert(play_command_t::BEHAVIOR_AUTO == static_cast<int>(Behavior::kAuto));
static_assert(play_command_t::BEHAVIOR_KEEP_GOAL == static_cast<int>(Behavior::kKeepGoal));
static_assert(play_command_t::ROLE_KEEPER == static_cast<int>(PlayRole::kKeeper));
static_assert(play_state_t::PHASE_DONE == static_cast<int>(PlayPhase::kDone));
static_assert(play_state_t::PHASE_GUARD == static_cast<int>(PlayPhase::kGuard));

/** Greatest coordinate of a target, m. Chosen: beyond every field and its odometry's drift. */
constexpr double kMaxTarget = 100;

}  // namespace

std::string_view to_string(Behavior behavior) {
  return name_in(kBehaviorNames, behavior);
}

std::string_view to_string(PlayPhase phase) {
  return name_in(kPlayPhaseNames, phase);
}

std::optional<Behavior> find_behavior(std::string_view name) {
  const auto* found = std::find(kBehaviorNames.begin(), kBehaviorNames.end(), name);
  if (found == kBehaviorNames.end()) return std::nullopt;
  return static_cast<Behavior>(found - kBehaviorNames.begin());
}

std::optional<Reason> check(const PlayCommand& command) {
  const int behavior = static_cast<int>(command.behavior);
  if (behavior < 0 || behavior > static_cast<int>(Behavior::kAuto)) {
    return Reason("behavior-unknown", {std::to_string(behavior)});
  }
  const int role = static_cast<int>(command.role);
  if (role < 0 || role > static_cast<int>(PlayRole::kKeeper)) {
    return Reason("role-unknown", {std::to_string(role)});
  }
  if (!command.target_in_odometry) return std::nullopt;
  for (const double coordinate : *command.target_in_odometry) {
    // Written so that NaN fails, too.
    if (!(std::abs(coordinate) <= kMaxTarget)) {
      return Reason("target-out-of-range", {to_argument(kMaxTarget)});
    }
  }
  return std::nullopt;
}

PlayCommand to_play_command(const naolcm::play_command_t& message) {
  PlayCommand command{static_cast<Behavior>(message.behavior), static_cast<PlayRole>(message.role)};
  if (message.has_target != 0) {
    command.target_in_odometry = {message.target_in_odometry[0], message.target_in_odometry[1]};
  }
  return command;
}

naolcm::play_command_t to_message(const PlayCommand& command) {
  naolcm::play_command_t message{};
  message.behavior = static_cast<int8_t>(command.behavior);
  message.role = static_cast<int8_t>(command.role);
  message.has_target = command.target_in_odometry ? 1 : 0;
  for (size_t i = 0; command.target_in_odometry && i < 2; ++i) {
    message.target_in_odometry[i] = (*command.target_in_odometry)[i];
  }
  return message;
}

}  // namespace nao
