#pragma once

#include <array>
#include <cstddef>
#include <deque>
#include <vector>

#include "messages/command.h"

namespace nao::motion {

/** Tells the ends of commands again, at kDelays after the first time: a bus may lose a message, and
 * a sender that was told "accepted" asks no more. */
class ResultReminder {
 public:
  /** s. Far enough apart not to be lost together. */
  static constexpr std::array kDelays = {0.1, 0.5};
  /** Of more ends than this in half a second the oldest are told no more. */
  static constexpr size_t kMostResults = 256;

  /** A result is being published. What a sender gets by asking again is left out: accepted and
   * refused. */
  void note(const CommandResult& result) {
    if (result.status == ResultStatus::kAccepted || result.status == ResultStatus::kRefused) return;
    told_.push_back({result});
    if (told_.size() > kMostResults) told_.pop_front();
  }

  /** @param dt  s since the last call. @return What to publish again now. */
  std::vector<CommandResult> due(double dt) {
    std::vector<CommandResult> results;
    for (Told& told : told_) {
      told.age += dt;
      if (told.age < kDelays[told.num_reminders]) continue;
      ++told.num_reminders;
      results.push_back(told.result);
    }
    std::erase_if(told_, [](const Told& told) { return told.num_reminders == kDelays.size(); });
    return results;
  }

 private:
  struct Told {
    CommandResult result;
    /** s. */
    double age = 0;
    size_t num_reminders = 0;
  };
  std::deque<Told> told_;
};

}  // namespace nao::motion
