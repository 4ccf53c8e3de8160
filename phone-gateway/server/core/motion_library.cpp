#include "phone-gateway/server/core/motion_library.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "phone-gateway/server/core/motion_messages.h"

namespace nao::gateway {
namespace {

Reason unavailable() {
  return gateway_reason("motion-files-unavailable");
}

/** The error code of a refusal by nao-motion-files. */
naoremote::ErrorCode error_of(const std::string& reason_code) {
  const bool is_name_in_use =
      reason_code == "motion-name-in-use" || reason_code == "action-name-in-use";
  return is_name_in_use ? naoremote::NAME_IN_USE : naoremote::INVALID_ARGUMENT;
}

void write_result(const MotionFileCommand& command, const MotionFileResult& result,
                  naoremote::Response& response) {
  if (!result.is_ok) {
    response.set_error(error_of(result.reason.code));
    write_reason(result.reason, response);
    // nao-motion-files' own sentence: a newer one may send codes that this gateway does not know.
    if (!result.sentence.empty()) response.set_message(result.sentence);
  }
  switch (command.operation) {
    case MotionFileOperation::kGet:
      if (!result.is_ok) return;
      *response.mutable_motion_file()->mutable_motion() = to_protocol(result.motion);
      response.mutable_motion_file()->set_yaml(result.yaml);
      return;
    case MotionFileOperation::kCheck:
    case MotionFileOperation::kSave: {
      naoremote::MotionReport& report = *response.mutable_motion_report();
      report.set_is_safe(result.is_ok);
      report.set_keyframe(result.keyframe);
      report.set_repair(result.repair);
      if (!result.motion.keyframes.empty()) {
        *report.mutable_repaired() = to_protocol(result.motion);
      }
      return;
    }
    default:
      return;
  }
}

}  // namespace

std::vector<std::string> MotionLibrary::listed() const {
  std::vector<std::string> names;
  std::copy_if(names_.begin(), names_.end(), std::back_inserter(names),
               [](const std::string& name) { return !is_temporary_motion(name); });
  return names;
}

bool MotionLibrary::has(const std::string& name) const {
  return std::binary_search(names_.begin(), names_.end(), name);
}

std::optional<Refusal> MotionLibrary::request(uint32_t client, uint32_t request_id,
                                              MotionFileCommand command, double now) {
  if (now - last_heard_ > limits_.motion_files_timeout) {
    return Refusal{naoremote::ROBOT_UNAVAILABLE, unavailable()};
  }
  const auto num_of_client =
      std::count_if(sender_.entries().begin(), sender_.entries().end(),
                    [client](const auto& pending) { return pending.receiver.client == client; });
  if (num_of_client >= limits_.max_motion_requests) {
    return Refusal{naoremote::TOO_MANY_REQUESTS, gateway_reason("motion-files-busy")};
  }
  command.source = source_;
  command.id = next_id_++;
  sender_.send(std::move(command), now, {client, request_id},
               {.repeat_period = limits_.motion_file_repeat_period,
                .answer_timeout = limits_.motion_file_timeout});
  step(now);
  return std::nullopt;
}

void MotionLibrary::handle_result(const MotionFileResult& result, double now) {
  last_heard_ = now;
  set_names(result.names);
  const auto pending = sender_.handle_result(result.source, result.id, ResultStatus::kDone, now);
  if (pending) answer(*pending, &result);
}

void MotionLibrary::set_names(const std::vector<std::string>& names) {
  const std::vector<std::string> before = listed();
  names_ = names;
  std::sort(names_.begin(), names_.end());
  const std::vector<std::string> after = listed();
  if (after == before) return;
  naoremote::ServerMessage message;
  message.mutable_notice()->set_kind(naoremote::Notice::MOTIONS_CHANGED);
  for (const std::string& name : after)
    message.mutable_notice()->mutable_motions()->add_names(name);
  sessions_.broadcast(message);
}

void MotionLibrary::step(double now) {
  // Also of a client that watches another robot by now: every request is answered.
  sender_.take_if([this](const Sender::Entry& pending) {
    return sessions_.all().find(pending.receiver.client) == nullptr;
  });
  const bool is_silent = now - last_heard_ > limits_.motion_files_timeout;
  for (const Sender::Entry& pending :
       is_silent ? sender_.take_if([](const Sender::Entry&) { return true; })
                 : sender_.take_timed_out(now)) {
    answer(pending, nullptr);
  }
  for (const MotionFileCommand& command : sender_.take_due(now)) transmit_(command);
}

void MotionLibrary::answer(const Sender::Entry& pending, const MotionFileResult* result) const {
  ClientSession* session = sessions_.all().find(pending.receiver.client);
  if (session == nullptr) return;
  naoremote::ServerMessage message;
  naoremote::Response& response = *message.mutable_response();
  response.set_request_id(pending.receiver.request_id);
  if (result != nullptr) {
    write_result(pending.command, *result, response);
  } else {
    response.set_error(naoremote::ROBOT_UNAVAILABLE);
    write_reason(unavailable(), response);
  }
  if (response.error() != naoremote::OK) ++session->num_refused;
  session->send(message);
}

}  // namespace nao::gateway
