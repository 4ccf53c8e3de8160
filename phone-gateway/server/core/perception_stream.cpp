#include "phone-gateway/server/core/perception_stream.h"

#include <utility>

#include "phone-gateway/protocol/framing.h"

namespace nao::gateway {

void PerceptionStream::set(naoremote::Vision vision) {
  naoremote::ServerMessage message;
  *message.mutable_vision() = std::move(vision);
  vision_ = encode(message);
  newest_vision_ = message.vision();
  sessions_.for_each([](ClientSession& session) {
    if (session.streams.subscription.has_vision) session.request_vision();
  });
}

void PerceptionStream::set(naoremote::PlayState state) {
  naoremote::ServerMessage message;
  *message.mutable_play_state() = std::move(state);
  play_state_ = encode(message);
  sessions_.for_each([](ClientSession& session) {
    if (session.streams.subscription.has_play_state) session.request_play_state();
  });
}

}  // namespace nao::gateway
