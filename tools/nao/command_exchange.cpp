#include "tools/nao/command_exchange.h"

namespace nao {

void CommandExchange::handle_result(ResultStatus status, const std::string& reason, double now) {
  if (!sender_.handle_result("", 0, status, now)) return;
  is_accepted_ = true;
  if (status == ResultStatus::kAccepted) return;
  result_ = Outcome{status == ResultStatus::kDone, to_string(status), reason};
}

std::optional<CommandExchange::Outcome> CommandExchange::outcome(double now) {
  for (const auto& entry : sender_.take_timed_out(now)) {
    result_ =
        entry.is_accepted
            ? Outcome{false, "silent", program_ + " accepted the command, then stopped publishing"}
            : Outcome{false, "unanswered", program_ + " does not answer; is it running?"};
  }
  return result_;
}

}  // namespace nao
