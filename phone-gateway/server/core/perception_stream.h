#pragma once

#include "phone-gateway/server/core/message_bytes.h"
#include "phone-gateway/server/core/robot_sessions.h"
#include "remote.pb.h"

namespace nao::gateway {

/** What nao-vision sees and what nao-play does, for the clients that have subscribed to it. */
class PerceptionStream {
 public:
  /** `sessions` must outlive this. */
  explicit PerceptionStream(const RobotSessions& sessions) : sessions_(sessions) {}

  void set(naoremote::Vision vision);
  void set(naoremote::PlayState state);

  /** The newest one as a message; null if there is none. */
  MessageBytes make_vision_message() const { return vision_; }
  MessageBytes make_play_state_message() const { return play_state_; }
  /** The newest one; empty before the first. */
  const naoremote::Vision& vision() const { return newest_vision_; }

 private:
  const RobotSessions& sessions_;
  /** Encoded once for all clients. */
  MessageBytes vision_;
  naoremote::Vision newest_vision_;
  MessageBytes play_state_;
};

}  // namespace nao::gateway
