#include "phone-gateway/server/core/service_commands.h"

#include <algorithm>
#include <utility>

#include "phone-gateway/server/core/client_commands.h"

namespace nao::gateway {
namespace {

/** As of CommandTracker: a bound of memory. */
constexpr size_t kMaxServiceCommands = 256;

bool is_speech(const ServiceCommand& command) {
  return std::holds_alternative<SpeechCommand>(command.request);
}

}  // namespace

void ServiceCommands::send(uint32_t client, uint32_t request_id,
                           decltype(ServiceCommand::request) request, double now) {
  CommandRetry::Timing timing;
  timing.repeat_period = limits_.repeat_period;
  timing.answer_timeout = limits_.answer_timeout;
  entries_.push_back({client,
                      request_id,
                      {source_ + "." + std::to_string(client), next_id_++, std::move(request)},
                      CommandRetry(timing, now)});
  if (entries_.size() > kMaxServiceCommands) entries_.pop_front();
  Entry& entry = entries_.back();
  if (entry.retry.should_send(now)) transmit_(entry.command);
}

void ServiceCommands::handle_result(const CommandResult& result, double now) {
  const auto found = std::find_if(entries_.begin(), entries_.end(), [&](const Entry& entry) {
    return entry.command.id == result.id && entry.command.source == result.source;
  });
  if (found == entries_.end() || !found->retry.handle_result(result.status, now)) return;
  report(*found, result.status, result.reason,
         result.sentence.empty() ? describe_reason(result.reason) : result.sentence);
  if (found->retry.has_ended()) entries_.erase(found);
}

void ServiceCommands::step(double now) {
  for (Entry& entry : entries_) {
    if (entry.retry.should_send(now)) transmit_(entry.command);
  }
  std::erase_if(entries_, [&](const Entry& entry) {
    if (!entry.retry.has_timed_out(now)) return false;
    const std::string seconds = to_argument(limits_.answer_timeout);
    const Reason reason = is_speech(entry.command) ? gateway_reason("speech-unanswered", {seconds})
                                                   : gateway_reason("lights-unanswered", {seconds});
    report(entry, ResultStatus::kFailed, reason, describe_reason(reason));
    return true;
  });
}

void ServiceCommands::report(const Entry& entry, ResultStatus status, const Reason& reason,
                             const std::string& sentence) {
  ClientSession* session = sessions_.find(entry.client);
  if (session == nullptr) return;
  session->send(make_result_notice(entry.request_id, status, reason, sentence,
                                   is_speech(entry.command) ? "say" : "lights"));
}

}  // namespace nao::gateway
