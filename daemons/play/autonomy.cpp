#include "daemons/play/autonomy.h"

namespace nao::play {
namespace {

/** Time after the last command after which a robot that was commanded before the match begins to
 * play, s: the time after which a phone's lease passes to another client that asks
 * (phone-gateway/PROTOCOL.md, TakeControl). */
constexpr double kDrivenTimeout = 10;
/** Time between two repetitions of its own play command, s: less than its timeout. */
constexpr double kRequestPeriod = 0.5;

}  // namespace

Autonomy::Autonomy(bool is_enabled, int64_t first_id) : is_enabled_(is_enabled), id_(first_id) {}

void Autonomy::note_other_command(double now) {
  last_other_ = now;
  waits_ |= is_enabled_ && is_match_on_;
}

std::optional<int64_t> Autonomy::step(const AutonomyInput& input, double now) {
  is_match_on_ = input.is_match_on;
  if (!is_enabled_ || waits_ || !input.is_match_on || now - last_request_ < kRequestPeriod)
    return {};
  if (input.is_active) {
    if (!input.is_own) return {};
  } else {
    if (now - last_other_ < kDrivenTimeout || !input.has_robot) return {};
    ++id_;
  }
  last_request_ = now;
  return id_;
}

}  // namespace nao::play
