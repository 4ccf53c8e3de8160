#include "tools/nao/command_exchange.h"

namespace nao {

void CommandExchange::handle_result(ResultStatus status, const std::string& reason, double now) {
  const bool is_news = retry_.handle_result(status, now);
  if (is_news && retry_.has_ended()) {
    result_ = Outcome{status == ResultStatus::kDone, to_string(status), reason};
  }
}

std::optional<CommandExchange::Outcome> CommandExchange::outcome(double now) const {
  if (result_ || !retry_.has_timed_out(now)) return result_;
  if (retry_.is_accepted()) {
    return Outcome{false, "silent", program_ + " accepted the command, then stopped publishing"};
  }
  return Outcome{false, "unanswered", program_ + " does not answer; is it running?"};
}

}  // namespace nao
