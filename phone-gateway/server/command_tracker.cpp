#include "phone-gateway/server/command_tracker.h"

#include <algorithm>
#include <utility>

namespace nao {
namespace {

constexpr size_t kMaxEntries = 256;

/** Moves the entries for which `is_wanted` holds out of a queue. */
template <class Predicate>
std::vector<CommandTracker::Entry> take_if(std::deque<CommandTracker::Entry>& entries,
                                           Predicate is_wanted) {
  const auto middle =
      std::stable_partition(entries.begin(), entries.end(),
                            [&](const CommandTracker::Entry& entry) { return !is_wanted(entry); });
  std::vector<CommandTracker::Entry> taken(std::make_move_iterator(middle),
                                           std::make_move_iterator(entries.end()));
  entries.erase(middle, entries.end());
  return taken;
}

}  // namespace

void CommandTracker::add(uint32_t client, uint32_t request_id, const NumberedCommand& command,
                         double now) {
  Entry entry;
  entry.client = client;
  entry.request_id = request_id;
  entry.command = command;
  entry.repeats = !std::holds_alternative<WalkVelocity>(command.command);
  entry.first_sent = now;
  entry.next_repeat = now + limits_.repeat_period;
  entries_.push_back(std::move(entry));
  if (entries_.size() > kMaxEntries) entries_.pop_front();
}

std::vector<CommandTracker::Entry> CommandTracker::supersede(const MotionCommand& newer) {
  const bool newer_adds_up = std::holds_alternative<JointChange>(newer);
  return take_if(entries_, [&](const Entry& entry) {
    if (entry.is_answered || !entry.repeats) return false;
    return !(newer_adds_up && std::holds_alternative<JointChange>(entry.command.command));
  });
}

std::optional<CommandTracker::Entry> CommandTracker::answer(const std::string& source,
                                                            int64_t command_id,
                                                            CommandStatus status) {
  const auto found = std::find_if(entries_.begin(), entries_.end(), [&](const Entry& entry) {
    return entry.command.command_id == command_id && entry.command.source == source;
  });
  if (found == entries_.end()) return std::nullopt;
  if (status == CommandStatus::kAccepted) {
    if (std::exchange(found->is_answered, true)) return std::nullopt;
    return *found;
  }
  Entry entry = std::move(*found);
  entries_.erase(found);
  return entry;
}

bool CommandTracker::forget_client(uint32_t client) {
  bool leaves_walking = false;
  for (Entry& entry : entries_) {
    if (entry.client != client) continue;
    leaves_walking |= std::holds_alternative<RelativeGoal>(entry.command.command);
    entry.client = 0;
  }
  return leaves_walking;
}

std::vector<NumberedCommand> CommandTracker::due(double now) {
  std::vector<NumberedCommand> commands;
  for (Entry& entry : entries_) {
    if (!entry.repeats || entry.is_answered || now < entry.next_repeat) continue;
    entry.next_repeat = now + limits_.repeat_period;
    commands.push_back(entry.command);
  }
  return commands;
}

std::vector<CommandTracker::Entry> CommandTracker::take_unanswered(double now) {
  return take_if(entries_, [&](const Entry& entry) {
    return entry.repeats && !entry.is_answered && now - entry.first_sent >= limits_.answer_time;
  });
}

std::vector<CommandTracker::Entry> CommandTracker::take_all() {
  return take_if(entries_, [](const Entry&) { return true; });
}

}  // namespace nao
