#include "tools/nao-tools/channel_statistics.h"

#include "common/json_writer.h"
#include "message_reflection/message_types.h"
#include "tools/nao/text_table.h"

namespace nao {

void ChannelStatistics::add(const std::string& channel, const void* data, int size, double now) {
  if (period_start_ < 0) period_start_ = now;
  ChannelRecord& record = channels_[channel];
  record.last_time = now;
  ++record.num_messages;
  ++record.num_messages_in_period;
  record.num_bytes += size;
  record.num_bytes_in_period += size;
  const MessageType* type = find_message_type(data, size);
  record.type = type != nullptr ? type->name : "?";
  if (type == nullptr || !type->decodes(data, size)) ++record.num_undecodable;
}

void ChannelStatistics::finish_period(double now) {
  const double duration = now - period_start_;
  const bool is_measured = period_start_ >= 0 && duration > 0;
  for (auto& [name, record] : channels_) {
    record.rate = is_measured ? static_cast<double>(record.num_messages_in_period) / duration : 0;
    record.bytes_per_second =
        is_measured ? static_cast<double>(record.num_bytes_in_period) / duration : 0;
    record.num_messages_in_period = 0;
    record.num_bytes_in_period = 0;
  }
  period_start_ = now;
}

int64_t ChannelStatistics::num_undecodable() const {
  int64_t sum = 0;
  for (const auto& [name, record] : channels_) sum += record.num_undecodable;
  return sum;
}

std::string ChannelStatistics::to_text(double now) const {
  std::vector<std::vector<std::string>> rows{
      {"channel", "type", "Hz", "kB/s", "bytes each", "messages", "undecodable", "age s"}};
  for (const auto& [name, record] : channels_) {
    rows.push_back({name, record.type, format_number(record.rate, 1),
                    format_number(record.bytes_per_second / 1000, 1),
                    std::to_string(record.num_bytes / record.num_messages),
                    std::to_string(record.num_messages), std::to_string(record.num_undecodable),
                    format_number(now - record.last_time, 1)});
  }
  return format_table(rows);
}

std::string ChannelStatistics::to_json(double now) const {
  JsonWriter json;
  json.begin_array();
  for (const auto& [name, record] : channels_) {
    json.begin_object();
    json.add("channel", name);
    json.add("type", record.type);
    json.add("rate_hz", record.rate);
    json.add("bytes_per_second", record.bytes_per_second);
    json.add("messages", record.num_messages);
    json.add("undecodable", record.num_undecodable);
    json.add("age_s", now - record.last_time);
    json.end();
  }
  return json.take();
}

}  // namespace nao
