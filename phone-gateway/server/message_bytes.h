#pragma once

#include <memory>
#include <string>
#include <utility>

#include "remote.pb.h"

namespace nao {

/** A serialized ServerMessage, shared by all connections that send it. */
using MessageBytes = std::shared_ptr<const std::string>;

inline MessageBytes encode(const naoremote::ServerMessage& message) {
  return std::make_shared<const std::string>(message.SerializeAsString());
}

/** A message that many clients get at nearly the same moment, encoded once for them all.
 *
 * Such a message tells its age when it was sent, so that its bytes serve only for a moment. */
class SharedEncoding {
 public:
  /** @param make  Returns the message as it is at `now`. @param now  s. */
  template <class Make>
  MessageBytes get(double now, Make make) {
    if (!bytes_ || now - made_at_ > kMoment) {
      bytes_ = encode(make());
      made_at_ = now;
    }
    return bytes_;
  }

  /** What the message tells has changed. */
  void reset() { bytes_.reset(); }

 private:
  /** By so much may the age that is told be too small, s: less than anybody sees. */
  static constexpr double kMoment = 0.001;

  MessageBytes bytes_;
  double made_at_ = 0;
};

}  // namespace nao
