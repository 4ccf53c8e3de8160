#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "messages/command.h"
#include "phone-gateway/server/core/gateway_limits.h"

namespace nao::gateway {

/** The driver's walk: transmitted at a fixed rate while the driver repeats it, ended with zero
 * velocity when the driver stops repeating it.
 *
 * Zero velocity is transmitted three times, since the bus may lose a message. If all are lost,
 * nao-motion ends the walk itself 0.5 s after the last command. */
class WalkStream {
 public:
  explicit WalkStream(const GatewayLimits& limits) : limits_(limits) {}

  /** True from begin() until the walk ends; false while zero velocity is transmitted. */
  bool is_walking() const { return is_walking_; }
  const std::string& source() const { return source_; }
  int64_t command_id() const { return command_id_; }

  /** Begins a walk with a number of its own. */
  void begin(std::string source, int64_t command_id);
  /** Sets the commanded velocity. @return The command to transmit now. */
  Command update(const WalkCommand& velocity, double now);
  /** Ends the walk: zero velocity is transmitted from now on. */
  void end(double now);
  /** Another command replaces the walk: nothing more is transmitted. */
  void abandon();

  /** @return The command that is due now, if any. */
  std::optional<Command> step(double now);

 private:
  GatewayLimits limits_;
  bool is_walking_ = false;
  int num_zeros_left_ = 0;
  std::string source_;
  int64_t command_id_ = 0;
  WalkCommand velocity_;
  double last_update_ = 0;
  double next_repeat_ = 0;
};

}  // namespace nao::gateway
