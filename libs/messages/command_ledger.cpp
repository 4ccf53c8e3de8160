#include "messages/command_ledger.h"

namespace nao {

const CommandResult* CommandLedger::find(const std::string& source, int64_t id) const {
  const auto found = results_.find({source, id});
  return found == results_.end() ? nullptr : &found->second;
}

// A second result of the same command (done after accepted) replaces the first and keeps its place.
void CommandLedger::note(const CommandResult& result) {
  const Key key{result.source, result.id};
  const bool is_new = results_.insert_or_assign(key, result).second;
  if (!is_new) return;
  order_.push_back(key);
  if (order_.size() > capacity_) drop_oldest();
}

void CommandLedger::drop_oldest() {
  // The few commands that still run move to the end of the queue: their final result is to come.
  for (size_t i = 0; i < order_.size(); ++i) {
    const Key key = order_.front();
    order_.pop_front();
    const auto found = results_.find(key);
    if (found->second.status != ResultStatus::kAccepted) {
      results_.erase(found);
      return;
    }
    order_.push_back(key);
  }
}

}  // namespace nao
