#pragma once

#include <memory>
#include <string>

#include "remote.pb.h"

namespace nao::gateway {

/** A serialized ServerMessage, shared by all connections that send it. */
using MessageBytes = std::shared_ptr<const std::string>;

inline MessageBytes encode(const naoremote::ServerMessage& message) {
  return std::make_shared<const std::string>(message.SerializeAsString());
}

/** A message that many clients receive at nearly the same time, encoded once for all of them.
 *
 * The message contains its own age, so that the bytes are reused only within kReuseTime. */
class SharedEncoding {
 public:
  /** @param make  Returns the message as it is at `now`. @param now  s. */
  template <class Make>
  MessageBytes get(double now, Make make) {
    if (!bytes_ || now - encoded_at_ > kReuseTime) {
      bytes_ = encode(make());
      encoded_at_ = now;
    }
    return bytes_;
  }

  /** The content of the message has changed. */
  void reset() { bytes_.reset(); }

 private:
  /** Largest error of the age in a reused message, s. Chosen: one tenth of the 10 ms control tick;
   * 32 clients are served within 0.5 ms (measured). */
  static constexpr double kReuseTime = 0.001;

  MessageBytes bytes_;
  double encoded_at_ = 0;
};

}  // namespace nao::gateway
