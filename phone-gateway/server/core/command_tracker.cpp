#include "phone-gateway/server/core/command_tracker.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace nao::gateway {
namespace {

/** Chosen: at 100 requests a second of 128 clients and an answer within one control tick, about 128
 * commands are unanswered at a time. The bound limits memory while nao-motion does not answer. */
constexpr size_t kMaxEntries = 256;

/** Moves the entries for which `is_taken` holds out of a queue. */
template <class Predicate>
std::vector<CommandTracker::Entry> take_if(std::deque<CommandTracker::Entry>& entries,
                                           Predicate is_taken) {
  const auto first_taken =
      std::stable_partition(entries.begin(), entries.end(),
                            [&](const CommandTracker::Entry& entry) { return !is_taken(entry); });
  std::vector<CommandTracker::Entry> taken(std::make_move_iterator(first_taken),
                                           std::make_move_iterator(entries.end()));
  entries.erase(first_taken, entries.end());
  return taken;
}

bool is_walk(const CommandTracker::Entry& entry) {
  return kind_of(entry.command) == CommandKind::kWalk;
}

}  // namespace

void CommandTracker::add(uint32_t client, uint32_t request_id, const Command& command, double now) {
  // Walks are repeated by their own stream (WalkStream), with new velocities; they have no timeout.
  CommandRetry::Timing timing;
  const bool repeats = kind_of(command) != CommandKind::kWalk;
  timing.repeat_period = repeats ? limits_.repeat_period : CommandRetry::kNever;
  timing.answer_timeout = repeats ? limits_.answer_timeout : CommandRetry::kNever;
  CommandRetry retry(timing, now);
  // The caller transmits the command for the first time.
  (void)retry.should_send(now);
  entries_.push_back({client, request_id, command, retry});
  // The oldest is forgotten: its client gets no result.
  if (entries_.size() > kMaxEntries) entries_.pop_front();
}

std::vector<CommandTracker::Entry> CommandTracker::supersede(CommandKind newer) {
  return take_if(entries_, [&](const Entry& entry) {
    if (entry.retry.is_accepted() || is_walk(entry)) return false;
    // Joint changes add up: two of them may run one after the other.
    const bool add_up =
        newer == CommandKind::kJointChange && kind_of(entry.command) == CommandKind::kJointChange;
    return !add_up;
  });
}

std::optional<CommandTracker::Entry> CommandTracker::handle_result(const std::string& source,
                                                                   int64_t id, ResultStatus status,
                                                                   double now) {
  const auto found = std::find_if(entries_.begin(), entries_.end(), [&](const Entry& entry) {
    return entry.command.id == id && entry.command.source == source;
  });
  if (found == entries_.end() || !found->retry.handle_result(status, now)) return std::nullopt;
  if (!found->retry.has_ended()) return *found;
  Entry entry = std::move(*found);
  entries_.erase(found);
  return entry;
}

// The commands go on; only their results have no receiver any more. Tells whether a move-to is
// among them: the robot would go on walking without its driver.
bool CommandTracker::forget_client(uint32_t client) {
  bool has_move_to = false;
  for (Entry& entry : entries_) {
    if (entry.client != client) continue;
    has_move_to |= kind_of(entry.command) == CommandKind::kMoveTo;
    entry.client = 0;
  }
  return has_move_to;
}

std::vector<Command> CommandTracker::take_due(double now) {
  std::vector<Command> commands;
  for (Entry& entry : entries_) {
    if (entry.retry.should_send(now)) commands.push_back(entry.command);
  }
  return commands;
}

std::vector<CommandTracker::Entry> CommandTracker::take_timed_out(double now) {
  return take_if(entries_, [&](const Entry& entry) { return entry.retry.has_timed_out(now); });
}

std::vector<CommandTracker::Entry> CommandTracker::take_all() {
  return take_if(entries_, [](const Entry&) { return true; });
}

}  // namespace nao::gateway
