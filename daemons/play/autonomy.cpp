#include "daemons/play/autonomy.h"

#include <algorithm>

namespace nao::play {
namespace {

/** Time after another sender's last command after which a robot plays by itself again, s: the time
 * after which a phone's lease passes to another client that asks (phone-gateway/PROTOCOL.md,
 * TakeControl). After a stop it waits longer. Chosen: the person who stopped it may be about to
 * walk to it. */
constexpr double kDrivenTimeout = 10;
constexpr double kStoppedTimeout = 30;
/** Time between two repetitions of its own play command, s: less than its timeout. */
constexpr double kRequestPeriod = 0.5;

}  // namespace

Autonomy::Autonomy(bool is_enabled, int64_t first_id) : is_enabled_(is_enabled), id_(first_id) {}

void Autonomy::note_other_command(bool is_stop, double now) {
  const double pause = is_stop ? kStoppedTimeout - kDrivenTimeout : 0;
  last_other_ = std::max(last_other_, now + pause);
}

std::optional<int64_t> Autonomy::step(const AutonomyInput& input, double now) {
  if (!is_enabled_ || !input.is_match_on || now - last_request_ < kRequestPeriod) return {};
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
