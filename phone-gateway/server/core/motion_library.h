#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "messages/command_sender.h"
#include "messages/motion_file.h"
#include "phone-gateway/server/core/client_commands.h"
#include "phone-gateway/server/core/gateway_limits.h"
#include "phone-gateway/server/core/gateway_reasons.h"
#include "phone-gateway/server/core/robot_sessions.h"

namespace nao::gateway {

/** The taught motions, which nao-motion-files keeps: passes the clients' requests on to it and its
 * answers back, and tells all clients when the list changes.
 *
 * An answer may take seconds, since a motion is simulated before it is saved. Other requests of the
 * client are answered meanwhile. */
class MotionLibrary {
 public:
  /** @param source    Source of the commands, unique on the bus.
   * @param first_id  Number of the first command.
   * @param transmit  Puts a command on the bus.
   * `sessions` must outlive this. */
  MotionLibrary(const GatewayLimits& limits, const RobotSessions& sessions, std::string source,
                int64_t first_id, std::function<void(const MotionFileCommand&)> transmit)
      : limits_(limits),
        sessions_(sessions),
        source_(std::move(source)),
        next_id_(first_id),
        transmit_(std::move(transmit)) {}

  /** Names that clients see, sorted. */
  std::vector<std::string> listed() const;
  /** Whether there is a motion of this name, listed or temporary. */
  bool has(const std::string& name) const;

  /** Passes on a request, whose answer is sent later.
   * @param command  Its source and number are set here. @return Why it is refused at once. */
  [[nodiscard]] std::optional<Refusal> request(uint32_t client, uint32_t request_id,
                                               MotionFileCommand command, double now);

  /** Takes a result: an answer, or the list of motions. */
  void handle_result(const MotionFileResult& result, double now);

  /** Repeats what is unanswered, and answers what has timed out. */
  void step(double now);

 private:
  using Sender = CommandSender<MotionFileCommand, ClientRequest>;

  void set_names(const std::vector<std::string>& names);
  /** @param result  Nothing: no answer in time. */
  void answer(const Sender::Entry& pending, const MotionFileResult* result) const;

  GatewayLimits limits_;
  const RobotSessions& sessions_;
  std::string source_;
  int64_t next_id_;
  std::function<void(const MotionFileCommand&)> transmit_;
  Sender sender_;
  std::vector<std::string> names_;
  /** When nao-motion-files was heard last, s. */
  double last_heard_ = -1e9;
};

}  // namespace nao::gateway
