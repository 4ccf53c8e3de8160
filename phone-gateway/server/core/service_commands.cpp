#include "phone-gateway/server/core/service_commands.h"

#include <utility>

namespace nao::gateway {
namespace {

bool is_speech(const ServiceCommand& command) {
  return std::holds_alternative<SpeechCommand>(command.request);
}

}  // namespace

void ServiceCommands::send(ClientRequest receiver, decltype(ServiceCommand::request) request,
                           double now) {
  sender_.send({source_ + "." + std::to_string(receiver.client), next_id_++, std::move(request)},
               now, receiver);
  step(now);
}

void ServiceCommands::handle_result(const CommandResult& result, double now) {
  const auto entry = sender_.handle_result(result.source, result.id, result.status, now);
  if (!entry) return;
  report(*entry, result.status, result.reason,
         result.sentence.empty() ? describe_reason(result.reason) : result.sentence);
}

void ServiceCommands::step(double now) {
  for (const ServiceCommand& command : sender_.take_due(now)) transmit_(command);
  for (const Sender::Entry& entry : sender_.take_timed_out(now)) {
    const std::string seconds = to_argument(kAnswerTimeout);
    const Reason reason = is_speech(entry.command) ? gateway_reason("speech-unanswered", {seconds})
                                                   : gateway_reason("lights-unanswered", {seconds});
    report(entry, ResultStatus::kFailed, reason, describe_reason(reason));
  }
}

void ServiceCommands::report(const Sender::Entry& entry, ResultStatus status, const Reason& reason,
                             const std::string& sentence) {
  ClientSession* session = sessions_.find(entry.receiver.client);
  if (session == nullptr) return;
  session->send(make_result_notice(entry.receiver.request_id, status, reason, sentence,
                                   is_speech(entry.command) ? "say" : "lights"));
}

}  // namespace nao::gateway
