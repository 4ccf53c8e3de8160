#include "messages/command_retry.h"

#include <utility>

namespace nao {

bool CommandRetry::should_send(double now) {
  if (has_ended_) return false;
  // After acceptance the command is repeated more slowly, to hear of its result.
  const double period = is_accepted_ ? timing_.confirm_period : timing_.repeat_period;
  if (last_sent_ && now - *last_sent_ < period) return false;
  last_sent_ = now;
  return true;
}

bool CommandRetry::handle_result(ResultStatus status, double now) {
  last_heard_ = now;
  if (has_ended_) return false;
  // Only the first acceptance is news.
  if (status == ResultStatus::kAccepted) return !std::exchange(is_accepted_, true);
  has_ended_ = true;
  return true;
}

void CommandRetry::handle_sign_of_life(double now) {
  // A receiver that runs but has not answered has not received the command: that timeout goes on.
  if (is_accepted_) last_heard_ = now;
}

bool CommandRetry::has_timed_out(double now) const {
  const double timeout = is_accepted_ ? timing_.silence_timeout : timing_.answer_timeout;
  return !has_ended_ && now - last_heard_ >= timeout;
}

}  // namespace nao
