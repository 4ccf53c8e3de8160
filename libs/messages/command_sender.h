#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <iterator>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "messages/command.h"

namespace nao {

/** Time between two transmissions of a command that is not answered, and of a walk, s: twice the
 * least rate of walk_command_t. */
inline constexpr double kRepeatPeriod = 0.1;
/** Time from the first transmission until a command without an answer has failed, s. Chosen: 15
 * transmissions, all of which are lost only if the receiver does not run. */
inline constexpr double kAnswerTimeout = 1.5;
/** Transmissions of the end of a walk or of a behavior, which is not answered. With 1 % of messages
 * lost, all three are lost once in a million times; then the receiver ends it by its timeout. */
inline constexpr int kNumLast = 3;

/** Periods and timeouts of a command, s. */
struct CommandTiming {
  /** A period or timeout that never passes. */
  static constexpr double kNever = std::numeric_limits<double>::infinity();
  /** Between two transmissions while the command is not answered. */
  double repeat_period = kRepeatPeriod;
  /** Between two transmissions of an accepted command: the receiver repeats its latest result. */
  double confirm_period = kNever;
  /** From the first transmission until an unanswered command has timed out. */
  double answer_timeout = kAnswerTimeout;
  /** From the receiver's last message until an accepted command has timed out. */
  double silence_timeout = kNever;
  /** Transmissions that are left; below 0: any number. */
  int num_left = -1;

  /** Timing of a walk, which is repeated as long as it lasts; nobody waits for its results. */
  static constexpr CommandTiming of_stream() {
    return {.confirm_period = kRepeatPeriod, .answer_timeout = kNever};
  }
};

/** Commands of one sender on their way: decides when each is transmitted again.
 *
 * The bus may lose any message. Therefore a command is repeated until its receiver answers, which
 * executes it once. Time is an argument: s of any clock.
 *
 * @tparam Command   Has `source` and `id`, by which results name it.
 * @tparam Receiver  What the caller keeps with a command: who gets its results. */
template <class Command, class Receiver = std::monostate>
class CommandSender {
 public:
  struct Entry {
    Command command;
    Receiver receiver;
    CommandTiming timing;
    /** s; last_sent: nothing if it must be transmitted at once. */
    double last_heard;
    std::optional<double> last_sent = std::nullopt;
    bool is_accepted = false;
  };

  /** Commands that are kept; of more the oldest is forgotten. Chosen: at 100 requests a second of
   * 128 clients and an answer within one control tick, about 128 commands are unanswered. */
  static constexpr size_t kMaxEntries = 256;

  /** Adds a command: the next take_due() returns it. */
  void send(Command command, double now, Receiver receiver = {}, const CommandTiming& timing = {}) {
    entries_.push_back({std::move(command), std::move(receiver), timing, now});
    if (entries_.size() > kMaxEntries) entries_.pop_front();
  }

  /** Replaces the content of a command, such as a walk's velocity, by `command` of the same number.
   * @param at_once  The next take_due() returns it, otherwise when its period has passed.
   * @return false if the command has ended. */
  bool update(Command command, bool at_once) {
    Entry* const entry = find(command.id);
    if (entry == nullptr) return false;
    entry->command = std::move(command);
    if (at_once) entry->last_sent.reset();
    return true;
  }

  /** Replaces the content by the one that ends the command, such as the velocity zero; it is
   * transmitted kNumLast times. */
  void end(Command command) {
    Entry* const entry = find(command.id);
    if (entry == nullptr) return;
    entry->command = std::move(command);
    entry->timing.num_left = kNumLast;
    entry->last_sent.reset();
  }

  /** Something else replaces the command: it is not transmitted any more, and still gets results.
   */
  void cease(int64_t id) {
    if (Entry* const entry = find(id)) entry->timing.num_left = 0;
  }

  /** @return The commands to transmit now. */
  [[nodiscard]] std::vector<Command> take_due(double now) {
    std::vector<Command> due;
    for (Entry& entry : entries_) {
      CommandTiming& timing = entry.timing;
      const double period = entry.is_accepted ? timing.confirm_period : timing.repeat_period;
      // Below 0: the clock of a simulated robot was reset.
      const double since = entry.last_sent ? now - *entry.last_sent : CommandTiming::kNever;
      if (timing.num_left == 0 || (since >= 0 && since < period)) continue;
      if (timing.num_left > 0) --timing.num_left;
      entry.last_sent = now;
      due.push_back(entry.command);
    }
    return due;
  }

  /** Takes a result; the final one removes the command.
   * @return The command, with its receiver, if the result is news: the first acceptance or the
   *   final result. */
  std::optional<Entry> handle_result(const std::string& source, int64_t id, ResultStatus status,
                                     double now) {
    Entry* const entry = find(id);
    if (entry == nullptr || entry->command.source != source) return std::nullopt;
    entry->last_heard = now;
    if (status == ResultStatus::kAccepted) {
      if (std::exchange(entry->is_accepted, true)) return std::nullopt;
      return *entry;
    }
    return take_if([id](const Entry& taken) { return taken.command.id == id; }).front();
  }

  /** Any other message of the receiver: accepted commands have not timed out. A receiver that runs
   * but has not answered has not received the command: that timeout goes on. */
  void handle_sign_of_life(double now) {
    for (Entry& entry : entries_) {
      if (entry.is_accepted) entry.last_heard = now;
    }
  }

  /** Removes the commands whose receiver has not answered in time, or has fallen silent. */
  [[nodiscard]] std::vector<Entry> take_timed_out(double now) {
    return take_if([now](const Entry& entry) {
      return now - entry.last_heard >=
             (entry.is_accepted ? entry.timing.silence_timeout : entry.timing.answer_timeout);
    });
  }

  /** Removes the commands for which `is_taken` holds. */
  template <class Predicate>
  std::vector<Entry> take_if(Predicate is_taken) {
    const auto first = std::stable_partition(entries_.begin(), entries_.end(),
                                             [&](const Entry& entry) { return !is_taken(entry); });
    std::vector<Entry> taken(std::make_move_iterator(first),
                             std::make_move_iterator(entries_.end()));
    entries_.erase(first, entries_.end());
    return taken;
  }

  std::deque<Entry>& entries() { return entries_; }

 private:
  Entry* find(int64_t id) {
    const auto found = std::find_if(entries_.begin(), entries_.end(),
                                    [id](const Entry& entry) { return entry.command.id == id; });
    return found == entries_.end() ? nullptr : &*found;
  }

  std::deque<Entry> entries_;
};

}  // namespace nao
