#include "phone-gateway/server/core/match_board.h"

#include <utility>

namespace nao::gateway {

void MatchBoard::set(naoremote::Match match, double now) {
  match_ = std::move(match);
  has_match_ = true;
  last_told_ = now;
}

void MatchBoard::step(double now) {
  if (has_match_ && now - last_told_ > kTimeout) has_match_ = false;
  // A match has a half, so that its bytes are never empty.
  std::string bytes = has_match_ ? match_.SerializeAsString() : std::string();
  if (bytes == last_sent_) return;
  last_sent_ = std::move(bytes);
  naoremote::ServerMessage message;
  message.mutable_notice()->set_kind(naoremote::Notice::MATCH_CHANGED);
  if (has_match_) *message.mutable_notice()->mutable_match() = match_;
  sessions_.broadcast(message);
}

}  // namespace nao::gateway
