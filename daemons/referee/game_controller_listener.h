#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>

#include "common/rate_limiter.h"
#include "daemons/referee/game_controller_link.h"
#include "daemons/referee/game_controller_referee.h"

namespace nao::referee {

/** Passes the GameController's messages to the referee that follows it. Two GameControllers would
 * decide in turns: the first one does until it falls silent. */
class GameControllerListener {
 public:
  /** @param port, return_port  See GameControllerLink. @param referee  Must outlive this.
   * @param clock  s, monotonic. @throws Error  if the port cannot be opened. */
  GameControllerListener(uint16_t port, uint16_t return_port, GameControllerReferee& referee,
                         std::function<double()> clock);

  int descriptor() const { return link_.descriptor(); }
  uint16_t port() const { return link_.port(); }
  /** Takes what has arrived. */
  void receive();
  /** Sends a robot's message. @param team  0 or 1. */
  void send(GameControllerReturn answer, int team) const;
  /** Whether nothing has come for so long that there is no GameController. */
  bool is_silent() const;
  /** Address of a second GameController, which is not obeyed; empty if there is none. */
  std::string ignored() const;

 private:
  bool obeys(const GameControllerData& data);
  /** Logs a warning, at most once a minute the same one. */
  void warn(const std::string& text);

  GameControllerLink link_;
  GameControllerReferee& referee_;
  std::function<double()> clock_;
  double last_time_ = -1e9;
  std::string other_;
  double last_other_time_ = -1e9;
  /** By their text. */
  std::map<std::string, RateLimiter> warnings_;
};

}  // namespace nao::referee
