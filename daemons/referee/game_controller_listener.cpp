#include "daemons/referee/game_controller_listener.h"

#include <utility>

#include "common/error.h"
#include "common/logger.h"

namespace nao::referee {
namespace {

/** Time without a message of the GameController, which sends two a second, after which it counts as
 * gone, s. */
constexpr double kTimeout = 3;
/** Time between two equal warnings, s, and number of warnings for which that is remembered. Chosen:
 * messages come twice a second for a whole match, with a few causes. */
constexpr double kWarningPeriod = 60;
constexpr size_t kMaxWarnings = 20;

}  // namespace

GameControllerListener::GameControllerListener(uint16_t port, uint16_t return_port,
                                               GameControllerReferee& referee,
                                               std::function<double()> clock)
    : link_(port, return_port), referee_(referee), clock_(std::move(clock)) {
  logger::info("the GameController decides; UDP port {}, answers to port {}", link_.port(),
               return_port);
}

void GameControllerListener::receive() {
  while (const auto message = link_.receive()) {
    try {
      const GameControllerData data = decode_game_controller(*message);
      if (!obeys(data)) continue;
      referee_.receive(data);
      link_.accept_sender();
      last_time_ = clock_();
    } catch (const Error& error) {
      warn(std::string(error.what()) + "; it comes from " + link_.sender());
    }
  }
}

bool GameControllerListener::obeys(const GameControllerData& data) {
  if (!referee_.concerns(data)) return false;
  if (is_silent() || link_.is_from_controller()) return true;
  other_ = link_.sender();
  last_other_time_ = clock_();
  warn("the GameController at " + link_.controller() + " decides, and a second one at " + other_ +
       " is ignored; stop one of them, or choose with --team-numbers");
  return false;
}

void GameControllerListener::warn(const std::string& text) {
  if (warnings_.size() >= kMaxWarnings && !warnings_.contains(text)) warnings_.clear();
  RateLimiter& limiter = warnings_.try_emplace(text, kWarningPeriod).first->second;
  if (const auto num_suppressed = limiter.allow(clock_())) {
    logger::warn("{} ({} more such warnings)", text, *num_suppressed);
  }
}

void GameControllerListener::send(GameControllerReturn answer, int team) const {
  answer.team_number = referee_.team_number(team);
  link_.send(encode(answer));
}

bool GameControllerListener::is_silent() const {
  return clock_() - last_time_ > kTimeout;
}

std::string GameControllerListener::ignored() const {
  return clock_() - last_other_time_ < kTimeout ? other_ : "";
}

}  // namespace nao::referee
