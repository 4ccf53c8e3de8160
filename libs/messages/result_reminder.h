#pragma once

#include <array>
#include <cstddef>
#include <deque>
#include <vector>

#include "messages/command.h"

namespace nao {

/** Repeats final results at kDelays after they were published first: the bus may lose a message,
 * and a sender whose command was accepted does not ask again. */
class ResultReminder {
 public:
  /** s. Chosen: far enough apart not to be lost together. */
  static constexpr std::array kDelays = {0.1, 0.5};
  /** Results that are waiting to be repeated; of more, the oldest are not repeated. Chosen: as many
   * as the commands of one control step (MotionDaemon). */
  static constexpr size_t kMaxResults = 256;

  /** A result is being published. Accepted and refused results are not repeated: the sender repeats
   * its command until it gets one. */
  void note(const CommandResult& result) {
    if (result.status == ResultStatus::kAccepted || result.status == ResultStatus::kRefused) return;
    entries_.push_back({result});
    if (entries_.size() > kMaxResults) entries_.pop_front();
  }

  /** @param dt  s since the last call. @return Results to publish again now. */
  std::vector<CommandResult> due(double dt) {
    std::vector<CommandResult> results;
    for (Entry& entry : entries_) {
      entry.age += dt;
      if (entry.age < kDelays[entry.num_repetitions]) continue;
      ++entry.num_repetitions;
      results.push_back(entry.result);
    }
    std::erase_if(entries_,
                  [](const Entry& entry) { return entry.num_repetitions == kDelays.size(); });
    return results;
  }

 private:
  struct Entry {
    CommandResult result;
    /** s since it was published first. */
    double age = 0;
    size_t num_repetitions = 0;
  };
  std::deque<Entry> entries_;
};

}  // namespace nao
