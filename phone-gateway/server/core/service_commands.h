#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <variant>

#include "messages/command_sender.h"
#include "messages/light_command.h"
#include "messages/speech_command.h"
#include "phone-gateway/server/core/client_commands.h"
#include "phone-gateway/server/core/gateway_reasons.h"
#include "phone-gateway/server/core/robot_sessions.h"

namespace nao::gateway {

/** A command that nao-motion does not execute: nao-speaker's, or one for the robot's lights. */
struct ServiceCommand {
  std::string source;
  int64_t id = 0;
  std::variant<SpeechCommand, LightCommand> request;
};

/** Sends the clients' speech and light commands and reports their results to the clients. */
class ServiceCommands {
 public:
  /** @param source    Prefix of the commands' sources, unique on the bus: "phone.4711".
   * @param first_id  Number of the first command.
   * @param transmit  Puts a command on the bus.
   * `sessions` must outlive this. */
  ServiceCommands(const RobotSessions& sessions, std::string source, int64_t first_id,
                  std::function<void(const ServiceCommand&)> transmit)
      : sessions_(sessions),
        source_(std::move(source)),
        next_id_(first_id),
        transmit_(std::move(transmit)) {}

  /** Sends a checked command. */
  void send(ClientRequest receiver, decltype(ServiceCommand::request) request, double now);

  void handle_result(const CommandResult& result, double now);

  /** Repeats commands that are unanswered, and gives up those that are too long. */
  void step(double now);

  size_t size() { return sender_.entries().size(); }

 private:
  using Sender = CommandSender<ServiceCommand, ClientRequest>;

  void report(const Sender::Entry& entry, ResultStatus status, const Reason& reason,
              const std::string& sentence);

  const RobotSessions& sessions_;
  std::string source_;
  int64_t next_id_;
  std::function<void(const ServiceCommand&)> transmit_;
  Sender sender_;
};

}  // namespace nao::gateway
