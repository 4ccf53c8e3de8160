#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "messages/command_sender.h"
#include "phone-gateway/server/core/gateway_reasons.h"
#include "phone-gateway/server/core/robot_sessions.h"

namespace nao::gateway {

/** Notice of a command's result.
 * @param sentence  English sentence for the reason; may be empty if done.
 * @param command   What was done, in short. */
naoremote::ServerMessage make_result_notice(uint32_t request_id, ResultStatus status,
                                            const Reason& reason, const std::string& sentence,
                                            const std::string& command);

/** The request that a command belongs to; client 0 is the gateway itself. */
struct ClientRequest {
  uint32_t client = 0;
  uint32_t request_id = 0;
};

/** Sends the clients' commands to nao-motion and reports their results to the clients. */
class ClientCommands {
 public:
  /** @param source    Prefix of the commands' sources, unique on the bus: "phone.4711".
   * @param first_id  Number of the first command.
   * @param transmit  Puts a command on the bus.
   * `sessions` must outlive this. */
  ClientCommands(const RobotSessions& sessions, std::string source, int64_t first_id,
                 std::function<void(const Command&)> transmit)
      : sessions_(sessions),
        source_(std::move(source)),
        next_id_(first_id),
        transmit_(std::move(transmit)) {}

  /** A command of a client, with a number of its own. */
  Command make(uint32_t client, decltype(Command::request) request);

  /** Sends a command and repeats it until nao-motion answers, a walk as long as it lasts. It
   * replaces the unanswered commands before it; joint changes add up and do not replace one
   * another. */
  void send(ClientRequest request, const Command& command, double now);

  /** Sends another velocity of a walk. */
  void update_walk(const Command& walk, double now);
  /** Ends a walk with the velocity zero. */
  void end_walk(const Command& walk, double now);
  /** Another command replaces the walk: nothing more is transmitted. */
  void abandon_walk(const Command& walk) { sender_.cease(walk.id); }

  /** Reports a result to the client that sent the command. */
  void handle_result(const CommandResult& result, double now);

  /** The client has disconnected: it gets no results.
   * @return true if it leaves a MoveTo behind that must be stopped. */
  bool forget_client(uint32_t client);

  /** Reports every command as failed. */
  void fail_all(const Reason& reason, double now);

  /** Repeats what is unanswered and reports what has timed out. */
  void step(double now);

 private:
  using Sender = CommandSender<Command, ClientRequest>;

  void transmit_due(double now);
  void report(const Sender::Entry& entry, ResultStatus status, const Reason& reason, double now);
  /** @param sentence  English sentence for the reason. */
  void report(const Sender::Entry& entry, ResultStatus status, const Reason& reason,
              const std::string& sentence, double now);
  bool is_repeated_walk_refusal(const std::string& sentence, double now);

  const RobotSessions& sessions_;
  std::string source_;
  int64_t next_id_;
  std::function<void(const Command&)> transmit_;
  Sender sender_;
  /** Sentence of the last refusal of a walk that was reported, and when, s. */
  std::string last_walk_refusal_;
  double last_walk_refusal_time_ = -1e9;
};

}  // namespace nao::gateway
