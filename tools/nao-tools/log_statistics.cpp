#include "tools/nao-tools/log_statistics.h"

#include <algorithm>
#include <ctime>
#include <optional>

#include "common/json_writer.h"
#include "message_reflection/message_types.h"
#include "message_reflection/message_walk.h"
#include "tools/nao/text_table.h"

namespace nao {
namespace {

/** Finds the control tick of a message. */
class TickFinder : public MessageVisitor {
 public:
  std::optional<int64_t> tick;
  void begin_struct(const std::string& /*key*/) override { ++depth_; }
  void end_struct() override { --depth_; }
  void begin_list(const std::string& /*key*/) override {}
  void end_list() override {}
  void integer(const std::string& key, int64_t value) override {
    if (depth_ == 0 && key == "tick") tick = value;
  }
  void number(const std::string& /*key*/, double /*value*/) override {}
  void boolean(const std::string& /*key*/, bool /*value*/) override {}
  void text(const std::string& /*key*/, const std::string& /*value*/) override {}
  void bytes(const std::string& /*key*/, std::span<const uint8_t> /*value*/) override {}

 private:
  int depth_ = 0;
};

std::string date_text(int64_t utime) {
  const std::time_t seconds = utime / 1000000;
  std::tm calendar{};
  gmtime_r(&seconds, &calendar);
  char text[40];
  return {text, std::strftime(text, sizeof text, "%Y-%m-%d %H:%M:%S UTC", &calendar)};
}

}  // namespace

double LoggedChannel::rate() const {
  const auto span = static_cast<double>(last_utime - first_utime) * 1e-6;
  // n messages have n - 1 intervals between them.
  return span > 0 ? static_cast<double>(num_messages - 1) / span : 0.0;
}

int64_t LoggedChannel::num_missing_ticks() const {
  if (ticks.empty()) return 0;
  // Ticks rise by 1: the numbers between the first and the last one that did not arrive are
  // missing. A set counts repeated ones once.
  return *ticks.rbegin() - *ticks.begin() + 1 - static_cast<int64_t>(ticks.size());
}

void LogStatistics::add(const LogEvent& event) {
  if (channels_.empty()) first_utime_ = last_utime_ = event.wall_utime;
  first_utime_ = std::min(first_utime_, event.wall_utime);
  last_utime_ = std::max(last_utime_, event.wall_utime);
  LoggedChannel& channel = channels_[event.channel];
  if (channel.num_messages == 0) channel.first_utime = channel.last_utime = event.wall_utime;
  channel.longest_gap = std::max(channel.longest_gap,
                                 static_cast<double>(event.wall_utime - channel.last_utime) * 1e-6);
  channel.last_utime = event.wall_utime;
  ++channel.num_messages;
  channel.num_bytes += static_cast<int64_t>(event.data.size());

  const MessageType* type =
      find_message_type(event.data.data(), static_cast<int>(event.data.size()));
  channel.type = type != nullptr ? type->name : "?";
  const MessageLayout* layout = type != nullptr ? find_message_layout(type->name) : nullptr;
  TickFinder finder;
  if (layout == nullptr || !walk_message(*layout, event.data, finder)) {
    ++channel.num_undecodable;
  } else if (finder.tick) {
    channel.ticks.insert(*finder.tick);
  }
}

int64_t LogStatistics::num_messages() const {
  int64_t sum = 0;
  for (const auto& [name, channel] : channels_) sum += channel.num_messages;
  return sum;
}

double LogStatistics::duration() const {
  return static_cast<double>(last_utime_ - first_utime_) * 1e-6;
}

std::string LogStatistics::to_text() const {
  std::vector<std::vector<std::string>> rows{
      {"channel", "type", "messages", "Hz", "longest gap s", "kB", "missing ticks", "undecodable"}};
  for (const auto& [name, channel] : channels_) {
    rows.push_back({name, channel.type, std::to_string(channel.num_messages),
                    format_number(channel.rate(), 1), format_number(channel.longest_gap, 3),
                    format_number(static_cast<double>(channel.num_bytes) / 1000, 1),
                    channel.ticks.empty() ? "-" : std::to_string(channel.num_missing_ticks()),
                    std::to_string(channel.num_undecodable)});
  }
  return "from " + date_text(first_utime_) + ", " + format_number(duration(), 1) + " s, " +
         std::to_string(num_messages()) + " messages\n" + format_table(rows);
}

std::string LogStatistics::to_json() const {
  JsonWriter json;
  json.begin_object();
  json.add("first_wall_utime", int64_t{first_utime_});
  json.add("duration_s", duration());
  json.begin_array("channels");
  for (const auto& [name, channel] : channels_) {
    json.begin_object();
    json.add("channel", name);
    json.add("type", channel.type);
    json.add("messages", int64_t{channel.num_messages});
    json.add("bytes", int64_t{channel.num_bytes});
    json.add("rate_hz", channel.rate());
    json.add("longest_gap_s", channel.longest_gap);
    json.add("missing_ticks", int64_t{channel.num_missing_ticks()});
    json.add("undecodable", int64_t{channel.num_undecodable});
    json.end();
  }
  return json.take();
}

}  // namespace nao
