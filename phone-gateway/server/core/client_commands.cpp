#include "phone-gateway/server/core/client_commands.h"

#include <utility>

namespace nao::gateway {
namespace {

static_assert(static_cast<int>(ResultStatus::kAccepted) == naoremote::Notice::ACCEPTED);
static_assert(static_cast<int>(ResultStatus::kFailed) == naoremote::Notice::FAILED);

/** Time within which the same refusal of a walk is reported once, s. Chosen: a held joystick starts
 * a new walk every 0.2 s or faster, which would be ten or more notices in this time. */
constexpr double kWalkRefusalPeriod = 2.0;

}  // namespace

naoremote::ServerMessage make_result_notice(uint32_t request_id, ResultStatus status,
                                            const Reason& reason, const std::string& sentence,
                                            const std::string& command) {
  naoremote::ServerMessage message;
  naoremote::Notice& notice = *message.mutable_notice();
  notice.set_kind(naoremote::Notice::COMMAND_RESULT);
  notice.set_request_id(request_id);
  notice.set_status(static_cast<naoremote::Notice::Status>(status));
  if (sentence.empty() && status == ResultStatus::kDone) {
    write_reason(gateway_reason("command-done", {command}), notice);
  } else {
    write_reason(reason, notice);
    notice.set_message(sentence);
  }
  return message;
}

Command ClientCommands::make(uint32_t client, decltype(Command::request) request) {
  return {source_ + "." + std::to_string(client), next_id_++, std::move(request)};
}

void ClientCommands::send(ClientRequest request, const Command& command, double now) {
  // If older commands were still repeated, one of them could arrive last.
  const CommandKind newer = kind_of(command);
  for (const Sender::Entry& entry : sender_.take_if([newer](const Sender::Entry& older) {
         const CommandKind kind = kind_of(older.command);
         const bool add_up =
             newer == CommandKind::kJointChange && kind == CommandKind::kJointChange;
         return !older.is_accepted && kind != CommandKind::kWalk && !add_up;
       })) {
    report(entry, ResultStatus::kInterrupted, Reason("replaced-before-start"), now);
  }
  const bool is_walk = newer == CommandKind::kWalk;
  sender_.send(command, now, request, is_walk ? CommandTiming::of_stream() : CommandTiming());
  transmit_due(now);
}

void ClientCommands::update_walk(const Command& walk, double now) {
  sender_.update(walk, true);
  transmit_due(now);
}

void ClientCommands::end_walk(const Command& walk, double now) {
  sender_.end({walk.source, walk.id, WalkCommand{}});
  transmit_due(now);
}

// The commands go on; only their results have no receiver any more. Returns whether a move-to is
// among them: the robot would go on walking without its driver.
bool ClientCommands::forget_client(uint32_t client) {
  bool has_move_to = false;
  for (Sender::Entry& entry : sender_.entries()) {
    if (entry.receiver.client != client) continue;
    has_move_to |= kind_of(entry.command) == CommandKind::kMoveTo;
    entry.receiver.client = 0;
  }
  return has_move_to;
}

void ClientCommands::handle_result(const CommandResult& result, double now) {
  const auto entry = sender_.handle_result(result.source, result.id, result.status, now);
  if (!entry) return;
  // nao-motion's own sentence: a newer nao-motion may send codes that this gateway does not know.
  report(*entry, result.status, result.reason,
         result.sentence.empty() ? describe_reason(result.reason) : result.sentence, now);
}

void ClientCommands::fail_all(const Reason& reason, double now) {
  for (const Sender::Entry& entry : sender_.take_if([](const Sender::Entry&) { return true; })) {
    report(entry, ResultStatus::kFailed, reason, now);
  }
}

void ClientCommands::step(double now) {
  transmit_due(now);
  for (const Sender::Entry& entry : sender_.take_timed_out(now)) {
    report(entry, ResultStatus::kFailed,
           gateway_reason("command-unanswered", {to_argument(kAnswerTimeout)}), now);
  }
}

void ClientCommands::transmit_due(double now) {
  for (const Command& command : sender_.take_due(now)) transmit_(command);
}

void ClientCommands::report(const Sender::Entry& entry, ResultStatus status, const Reason& reason,
                            double now) {
  report(entry, status, reason, describe_reason(reason), now);
}

void ClientCommands::report(const Sender::Entry& entry, ResultStatus status, const Reason& reason,
                            const std::string& sentence, double now) {
  // The client may have left, or watch another robot.
  ClientSession* session = sessions_.find(entry.receiver.client);
  if (session == nullptr) return;
  const bool is_walk = kind_of(entry.command) == CommandKind::kWalk;
  if (is_walk && status == ResultStatus::kRefused && is_repeated_walk_refusal(sentence, now)) {
    return;
  }
  session->send(make_result_notice(entry.receiver.request_id, status, reason, sentence,
                                   describe(entry.command)));
}

bool ClientCommands::is_repeated_walk_refusal(const std::string& sentence, double now) {
  if (sentence == last_walk_refusal_ && now - last_walk_refusal_time_ < kWalkRefusalPeriod) {
    return true;
  }
  last_walk_refusal_ = sentence;
  last_walk_refusal_time_ = now;
  return false;
}

}  // namespace nao::gateway
