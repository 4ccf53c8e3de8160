#include "phone-gateway/server/core/play_stream.h"

#include <utility>

#include "phone-gateway/server/core/client_commands.h"

namespace nao::gateway {
namespace {

/** Transmissions of "none" and of the release. With 1 % of messages lost, all three are lost once
 * in a million times; then nao-play ends the behavior itself. */
constexpr int kNumTransmissions = 3;
/** A release is sent so long after control has ended, s, if nao-play says by the end of the second
 * time that the robot waits for it. Chosen: the last transmissions of a walk and of "none", which
 * would count as new commands, are over after 0.3 s; nao-play speaks five times a second. */
constexpr double kReleaseDelay = 0.5;
constexpr double kReleaseTimeout = 1.5;
/** An accepted command whose result is not repeated for so many periods: nao-play has ended. */
constexpr double kSilentPeriods = 4;

}  // namespace

SentPlayCommand PlayStream::make(uint32_t client, const PlayCommand& command) {
  return {source_ + "." + std::to_string(client), next_id_++, command};
}

bool PlayStream::is_heard(uint32_t client, double now) const {
  const ClientSession* session = sessions_.find(client);
  return session != nullptr && now - session->last_request < limits_.play_timeout;
}

void PlayStream::transmit(const SentPlayCommand& command) const {
  if (transmit_) transmit_(command);
}

void PlayStream::begin(uint32_t client, uint32_t request_id, const PlayCommand& command,
                       double now) {
  // nao-play reports that the new command replaces the old one.
  if (active_) ended_ = std::move(active_);
  num_last_left_ = 0;
  released_.reset();
  CommandRetry::Timing timing;
  timing.repeat_period = limits_.repeat_period;
  timing.confirm_period = limits_.play_period;
  timing.answer_timeout = limits_.answer_timeout;
  timing.silence_timeout = kSilentPeriods * limits_.play_period;
  active_.emplace(Entry{client, request_id, make(client, command), CommandRetry(timing, now)});
  if (active_->retry.should_send(now)) transmit(active_->sent);
}

void PlayStream::end(double now) {
  released_.reset();
  if (!active_) return;
  last_ = make(active_->client, {});
  ended_ = std::move(active_);
  active_.reset();
  num_last_left_ = kNumTransmissions;
  next_last_ = now;
  step(now);
}

void PlayStream::abandon() {
  if (active_) ended_ = std::move(active_);
  active_.reset();
  num_last_left_ = 0;
  released_.reset();
}

void PlayStream::handle_result(const CommandResult& result, double now) {
  for (std::optional<Entry>* entry : {&active_, &ended_}) {
    if (!*entry || (*entry)->sent.id != result.id || (*entry)->sent.source != result.source) {
      continue;
    }
    (*entry)->retry.handle_sign_of_life(now);
    if (!(*entry)->retry.handle_result(result.status, now)) return;
    report(**entry, result.status, result.reason,
           result.sentence.empty() ? describe_reason(result.reason) : result.sentence);
    if ((*entry)->retry.has_ended()) entry->reset();
    return;
  }
}

void PlayStream::step(double now) {
  if (active_ && !is_heard(active_->client, now)) end(now);
  if (active_ && active_->retry.has_timed_out(now)) {
    const Reason reason = gateway_reason("play-unanswered", {to_argument(limits_.answer_timeout)});
    report(*active_, ResultStatus::kFailed, reason, describe_reason(reason));
    active_.reset();
  }
  if (active_ && active_->retry.should_send(now)) transmit(active_->sent);
  if (released_ && now - *released_ > kReleaseTimeout) released_.reset();
  if (released_ && now - *released_ > kReleaseDelay && waits_for_release_) {
    released_.reset();
    last_ = make(0, {Behavior::kAuto});
    num_last_left_ = kNumTransmissions;
    next_last_ = now;
  }
  while (num_last_left_ > 0 && now >= next_last_) {
    --num_last_left_;
    next_last_ += limits_.repeat_period;
    transmit(last_);
  }
}

void PlayStream::report(const Entry& entry, ResultStatus status, const Reason& reason,
                        const std::string& sentence) const {
  ClientSession* session = sessions_.find(entry.client);
  if (session == nullptr) return;
  session->send(make_result_notice(entry.request_id, status, reason, sentence,
                                   std::string(to_string(entry.sent.command.behavior))));
}

}  // namespace nao::gateway
