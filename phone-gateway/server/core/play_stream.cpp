#include "phone-gateway/server/core/play_stream.h"

namespace nao::gateway {
namespace {

/** A release is sent so long after control has ended, s, if nao-play says by the end of the second
 * time that the robot waits for it. Chosen: the last transmissions of a walk and of "none", which
 * would count as new commands, are over after 0.3 s; nao-play speaks five times a second. */
constexpr double kReleaseDelay = 0.5;
constexpr double kReleaseTimeout = 1.5;
/** An accepted command whose result is not repeated for so many periods: nao-play has ended. */
constexpr double kSilentPeriods = 4;

}  // namespace

int64_t PlayStream::send(uint32_t client, ClientRequest receiver, const PlayCommand& command,
                         double now, const CommandTiming& timing) {
  const int64_t id = next_id_++;
  sender_.send({source_ + "." + std::to_string(client), id, command}, now, receiver, timing);
  transmit_due(now);
  return id;
}

void PlayStream::transmit_due(double now) {
  for (const SentPlayCommand& command : sender_.take_due(now)) transmit_(command);
}

bool PlayStream::is_heard(uint32_t client, double now) const {
  const ClientSession* session = sessions_.find(client);
  return session != nullptr && now - session->last_request < limits_.play_timeout;
}

void PlayStream::begin(uint32_t client, uint32_t request_id, const PlayCommand& command,
                       double now) {
  // nao-play reports that the new command replaces the old one.
  abandon();
  client_ = client;
  active_id_ = send(client, {client, request_id}, command, now,
                    {.confirm_period = limits_.play_period,
                     .silence_timeout = kSilentPeriods * limits_.play_period});
}

void PlayStream::end(double now) {
  released_.reset();
  if (!is_active()) return;
  abandon();
  last_id_ = send(client_, {}, {}, now, {.num_left = kNumLast});
}

void PlayStream::abandon() {
  sender_.cease(active_id_);
  sender_.cease(last_id_);
  active_id_ = 0;
  released_.reset();
}

void PlayStream::handle_result(const CommandResult& result, double now) {
  const auto entry = sender_.handle_result(result.source, result.id, result.status, now);
  if (!entry) return;
  report(*entry, result.status, result.reason,
         result.sentence.empty() ? describe_reason(result.reason) : result.sentence);
  if (result.status != ResultStatus::kAccepted && result.id == active_id_) active_id_ = 0;
}

void PlayStream::step(double now) {
  if (is_active() && !is_heard(client_, now)) end(now);
  for (const Sender::Entry& entry : sender_.take_timed_out(now)) {
    // Nobody waits for a result of a behavior that was replaced.
    if (entry.command.id != active_id_) continue;
    const Reason reason = gateway_reason("play-unanswered", {to_argument(kAnswerTimeout)});
    report(entry, ResultStatus::kFailed, reason, describe_reason(reason));
    active_id_ = 0;
  }
  if (released_ && now - *released_ > kReleaseTimeout) released_.reset();
  if (released_ && now - *released_ > kReleaseDelay && waits_for_release_) {
    released_.reset();
    last_id_ = send(0, {}, {Behavior::kAuto}, now, {.num_left = kNumLast});
  }
  transmit_due(now);
}

void PlayStream::report(const Sender::Entry& entry, ResultStatus status, const Reason& reason,
                        const std::string& sentence) const {
  ClientSession* session = sessions_.find(entry.receiver.client);
  if (session == nullptr) return;
  session->send(make_result_notice(entry.receiver.request_id, status, reason, sentence,
                                   std::string(to_string(entry.command.command.behavior))));
}

}  // namespace nao::gateway
