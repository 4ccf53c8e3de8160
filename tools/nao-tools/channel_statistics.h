#pragma once

#include <cstdint>
#include <map>
#include <string>

namespace nao {

/** Statistics of one channel. */
struct ChannelRecord {
  /** Type of the newest message; "?" if the type is unknown. */
  std::string type = "?";
  int64_t num_messages = 0;
  /** Messages of an unknown type, and messages that do not decode. */
  int64_t num_undecodable = 0;
  int64_t num_bytes = 0;
  /** Arrival of the newest message, s. */
  double last_time = 0;
  /** Messages and bytes since the last call of finish_period(). */
  int64_t num_messages_in_period = 0;
  int64_t num_bytes_in_period = 0;
  /** Messages and bytes per second in the last complete period. */
  double rate = 0;
  double bytes_per_second = 0;
};

/** Counts the messages of each channel of a bus. Time is an argument: s of any monotonic clock. */
class ChannelStatistics {
 public:
  /** Records a received message. */
  void add(const std::string& channel, const void* data, int size, double now);

  /** Computes the rates from the counts since the last call, or since the start. */
  void finish_period(double now);

  /** Statistics by channel name. */
  const std::map<std::string, ChannelRecord>& channels() const { return channels_; }

  /** Messages of all channels that could not be decoded. */
  int64_t num_undecodable() const;

  /** Text table: channel, type, rate, size, counts and age. */
  std::string to_text(double now) const;

  /** The same as a JSON array of objects. */
  std::string to_json(double now) const;

 private:
  std::map<std::string, ChannelRecord> channels_;
  double period_start_ = -1;
};

}  // namespace nao
