#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "messages/command_sender.h"
#include "messages/play_command.h"
#include "phone-gateway/server/core/client_commands.h"
#include "phone-gateway/server/core/gateway_limits.h"
#include "phone-gateway/server/core/robot_sessions.h"

namespace nao::gateway {

/** A play command with its sender and number. */
struct SentPlayCommand {
  std::string source;
  int64_t id = 0;
  PlayCommand command;
};

/** The driver's behavior: its command is repeated while the driver is heard of, and its results are
 * reported. nao-play ends the behavior 2 s after the last repetition; to end it at once, a command
 * with the behavior "none" is transmitted, three times, since the bus may lose a message. */
class PlayStream {
 public:
  /** @param source    Prefix of the commands' sources, unique on the bus: "phone.4711".
   * @param first_id  Number of the first command.
   * @param transmit  Puts a command on the bus.
   * `sessions` must outlive this. */
  PlayStream(const GatewayLimits& limits, const RobotSessions& sessions, std::string source,
             int64_t first_id, std::function<void(const SentPlayCommand&)> transmit)
      : limits_(limits),
        sessions_(sessions),
        source_(std::move(source)),
        next_id_(first_id),
        transmit_(std::move(transmit)) {}

  /** Begins a behavior instead of the one that runs. */
  void begin(uint32_t client, uint32_t request_id, const PlayCommand& command, double now);
  /** Ends the behavior at once, if there is one. */
  void end(double now);
  /** Another command replaces the behavior: nothing more is transmitted. */
  void abandon();
  /** The driver has released the robot on purpose: if it waits for that, it plays by itself again,
   * unless the next command comes first. */
  void release(double now) { released_ = now; }
  /** Whether nao-play says that the robot waits for its release. */
  void set_waits_for_release(bool waits) { waits_for_release_ = waits; }

  /** True from begin() to its end; false while "none" is transmitted. */
  bool is_active() const { return active_id_ != 0; }

  void handle_result(const CommandResult& result, double now);
  void step(double now);

 private:
  using Sender = CommandSender<SentPlayCommand, ClientRequest>;

  /** @return Number of the command. */
  int64_t send(uint32_t client, ClientRequest receiver, const PlayCommand& command, double now,
               const CommandTiming& timing);
  void transmit_due(double now);
  /** The client was heard of lately. */
  bool is_heard(uint32_t client, double now) const;
  void report(const Sender::Entry& entry, ResultStatus status, const Reason& reason,
              const std::string& sentence) const;

  GatewayLimits limits_;
  const RobotSessions& sessions_;
  std::string source_;
  int64_t next_id_;
  std::function<void(const SentPlayCommand&)> transmit_;
  Sender sender_;
  /** Number of the running behavior's command, and its client; 0: none. */
  int64_t active_id_ = 0;
  uint32_t client_ = 0;
  /** Number of "none", or of the release. */
  int64_t last_id_ = 0;
  bool waits_for_release_ = false;
  /** s: when the robot was released. */
  std::optional<double> released_;
};

}  // namespace nao::gateway
