#include "tools/nao/command_exchange.h"

namespace nao {

bool CommandExchange::should_send(double now) {
  const double period = is_accepted_ ? timing_.confirm_period : timing_.repeat_period;
  if (last_sent_ && now - *last_sent_ < period) return false;
  last_sent_ = now;
  return true;
}

void CommandExchange::handle_result(ResultStatus status, const std::string& reason,
                                    double now) {
  last_heard_ = now;
  if (status == ResultStatus::kAccepted) {
    is_accepted_ = true;
  } else if (!result_) {
    result_ = Outcome{status == ResultStatus::kDone, to_string(status), reason};
  }
}

void CommandExchange::handle_sign_of_life(double now) {
  if (is_accepted_) last_heard_ = now;
}

std::optional<CommandExchange::Outcome> CommandExchange::outcome(double now) const {
  if (result_ || now - last_heard_ < timing_.silence_limit) return result_;
  if (is_accepted_) return Outcome{false, "silent", "nao-motion accepted it, then fell silent"};
  return Outcome{false, "unanswered", "nao-motion does not answer; is it running?"};
}

}  // namespace nao
