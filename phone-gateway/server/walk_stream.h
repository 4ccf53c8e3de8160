#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "phone-gateway/server/gateway_limits.h"
#include "phone-gateway/server/motion_command.h"

namespace nao {

/** The driver's walk: repeated towards nao-motion while the driver repeats it, ended with zero
 * velocity when the driver stops doing so.
 *
 * Zero goes out three times, since the bus may lose one; if it lost all, nao-motion ends the walk
 * by itself 0.5 s after the last command. */
class WalkStream {
 public:
  explicit WalkStream(const GatewayLimits& limits) : limits_(limits) {}

  /** True while a walk is wanted (not while it is being ended). */
  bool is_walking() const { return is_walking_; }
  const std::string& source() const { return source_; }
  int64_t command_id() const { return command_id_; }

  /** A new walk begins. */
  void begin(std::string source, int64_t command_id);
  /** The driver wants this velocity. @return The command to send now. */
  NumberedCommand update(const WalkVelocity& velocity, double now);
  /** The walk ends now: zero velocity is sent. */
  void end(double now);
  /** Another command took over: nothing more is sent. */
  void abandon();

  /** @return The command that is due now, if any. */
  std::optional<NumberedCommand> step(double now);

 private:
  GatewayLimits limits_;
  bool is_walking_ = false;
  int num_zeros_left_ = 0;
  std::string source_;
  int64_t command_id_ = 0;
  WalkVelocity velocity_;
  double last_update_ = 0;
  double next_repeat_ = 0;
};

}  // namespace nao
