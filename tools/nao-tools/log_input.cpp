#include "tools/nao-tools/log_input.h"

#include <cstdio>

#include "common/error.h"
#include "inspection/message_json.h"
#include "message_reflection/message_types.h"
#include "tools/nao-tools/channel_pattern.h"

namespace nao {
namespace {

std::map<std::string, std::string> parse_renames(const std::vector<std::string>& renames) {
  std::map<std::string, std::string> names;
  for (const std::string& rename : renames) {
    const size_t middle = rename.find('=');
    if (middle == std::string::npos || middle == 0 || middle + 1 == rename.size()) {
      throw ConfigError("--rename " + rename + ": give OLD=NEW");
    }
    names[rename.substr(0, middle)] = rename.substr(middle + 1);
  }
  return names;
}

}  // namespace

LogInput::LogInput(const std::string& file) : file_(file), reader_(file), next_(next_message()) {
  if (!next_)
    throw Error(file + " contains no message: it is empty, or not a log of scripts/record");
  start_ = next_->wall_utime;
}

bool LogInput::read(LogEvent& event) {
  if (!next_) return false;
  event = std::move(*next_);
  next_ = next_message();
  return true;
}

std::optional<LogEvent> LogInput::next_message() {
  auto event = reader_.next();
  // LCM's own self-test message, sent whenever a program opens the bus.
  while (event && event->channel == "LCM_SELF_TEST") event = reader_.next();
  return event;
}

void LogInput::warn_about_damage() const {
  if (reader_.num_bytes_skipped() > 0) {
    std::fprintf(stderr,
                 "nao: log: %s: skipped %ld damaged bytes, by their numbers %ld messages (a killed "
                 "recorder truncates its last message)\n",
                 file_.c_str(), static_cast<long>(reader_.num_bytes_skipped()),
                 static_cast<long>(reader_.num_events_skipped()));
  }
  if (const LogClock& clock = reader_.clock(); clock.num_steps() > 0) {
    std::fprintf(
        stderr,
        "nao: log: %s: the times of the messages step %ld times, by up to %.1f s; the steps "
        "are left out, by the robot's time where it is known\n",
        file_.c_str(), static_cast<long>(clock.num_steps()), clock.longest_step());
  }
}

void add_part_options(CommandLine& command, LogPart& part) {
  command.add_option("--from", part.from, "Since the log's first message, s");
  command.add_option("--to", part.to, "Since the log's first message, s");
  command.add_option("--channels", part.channels,
                     "Only channels whose whole name matches this (extended) regular expression");
  command.add_option("--without", part.without, "Exclude channels that match this one");
  command.add_option("--rename", part.renames, "OLD=NEW: give a channel another name (repeatable)");
}

void read_part(LogInput& log, const LogPart& part,
               const std::function<void(LogEvent& event, double time)>& take) {
  const ChannelPattern selected("--channels", part.channels);
  const ChannelPattern excluded("--without", part.without);
  const auto names = parse_renames(part.renames);
  LogEvent event;
  while (log.read(event)) {
    const double time = log.time_of(event);
    if (time > part.to) return;
    if (time < part.from || !selected.matches(event.channel) || excluded.matches(event.channel)) {
      continue;
    }
    const auto name = names.find(event.channel);
    if (name != names.end()) event.channel = name->second;
    take(event, time);
  }
}

const MessageLayout* layout_of(const LogEvent& event) {
  const MessageType* type =
      find_message_type(event.data.data(), static_cast<int>(event.data.size()));
  return type != nullptr ? find_message_layout(type->name) : nullptr;
}

void Undecodable::note(const LogEvent& event, bool is_decoded) {
  Channel& channel = channels_[event.channel];
  channel.num_undecodable += is_decoded ? 0 : 1;
  channel.has_known_type = channel.has_known_type || is_decoded || layout_of(event) != nullptr;
}

void Undecodable::warn() const {
  for (const auto& [name, channel] : channels_) {
    if (channel.num_undecodable == 0) continue;
    std::fprintf(
        stderr, "nao: log: %s: skipped %ld %s\n", name.c_str(), channel.num_undecodable,
        channel.has_known_type
            ? "damaged messages"
            : "messages of unknown types; they were recorded by another version, whose nao "
              "can read them");
  }
}

Undecodable read_as_json(
    LogInput& log, const ChannelPattern& selected,
    const std::function<void(const LogEvent& event, const MessageLayout& layout,
                             const std::string& json)>& take) {
  Undecodable undecodable;
  LogEvent event;
  while (log.read(event)) {
    if (!selected.matches(event.channel)) continue;
    const MessageLayout* layout = layout_of(event);
    const auto message = layout != nullptr ? message_to_json(*layout, event.data) : std::nullopt;
    undecodable.note(event, message.has_value());
    if (message) take(event, *layout, *message);
  }
  return undecodable;
}

}  // namespace nao
