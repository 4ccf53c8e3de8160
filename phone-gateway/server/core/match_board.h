#pragma once

#include <string>

#include "phone-gateway/server/core/sessions.h"
#include "remote.pb.h"

namespace nao::gateway {

/** The match that is played, as all clients see it. */
class MatchBoard {
 public:
  /** Time without a message after which there is no match, s: fifteen of nao-referee's messages. */
  static constexpr double kTimeout = 3;

  /** @param sessions  Must outlive this. */
  explicit MatchBoard(Sessions& sessions) : sessions_(sessions) {}

  /** @param now  s. */
  void set(naoremote::Match match, double now);

  /** Nothing: no match is played. */
  const naoremote::Match* match() const { return has_match_ ? &match_ : nullptr; }

  /** Sends the match to all clients if it has changed. */
  void step(double now);

 private:
  Sessions& sessions_;
  naoremote::Match match_;
  bool has_match_ = false;
  double last_told_ = 0;
  /** Serialized, as it was sent last; empty: none. */
  std::string last_sent_;
};

}  // namespace nao::gateway
