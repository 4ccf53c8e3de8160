#include "tools/nao/channel_owners.h"

namespace nao {
namespace {

// A world that is reset sets the time back once.
constexpr int kMinBack = 2;
// Fraction of messages that repeat the time before, and number of different times. Chosen: two
// programs that answer each tick give 0.5; a world that stands still has one time only.
constexpr double kMinEqual = 0.4;
constexpr int kMinTimes = 5;
// An encoded message begins with the fingerprint of its type.
constexpr int kFingerprintBytes = 8;
constexpr int kTimeBytes = 8;

}  // namespace

void ChannelOwners::note(const std::string& channel, const uint8_t* message, int num_bytes) {
  if (num_bytes < kFingerprintBytes + kTimeBytes) return;
  uint64_t utime = 0;
  for (int i = 0; i < kTimeBytes; ++i) utime = utime << 8 | message[kFingerprintBytes + i];
  note(channel, static_cast<int64_t>(utime));
}

void ChannelOwners::note(const std::string& channel, int64_t utime) {
  Seen& seen = seen_[channel];
  if (seen.num_messages > 0) {
    seen.num_back += utime < seen.last ? 1 : 0;
    seen.num_equal += utime == seen.last ? 1 : 0;
  }
  ++seen.num_messages;
  seen.last = utime;
}

std::vector<std::string> ChannelOwners::find_shared() const {
  std::vector<std::string> shared;
  for (const auto& [channel, seen] : seen_) {
    const bool has_pairs = seen.num_messages - seen.num_equal >= kMinTimes &&
                           seen.num_equal >= kMinEqual * seen.num_messages;
    if (seen.num_back >= kMinBack || has_pairs) shared.push_back(channel);
  }
  return shared;
}

}  // namespace nao
