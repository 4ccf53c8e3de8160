#include "common/log_reader.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <utility>

#include "common/channels.h"
#include "common/error.h"

namespace nao {
namespace {

// Layout of an event, from LCM's eventlog.c: sync word, event number (8 bytes), time in us (8),
// length of the channel's name (4), length of the data (4), all most significant byte first.
constexpr uint32_t kSync = 0xEDA1DA01;
constexpr int kHeaderSize = 28;
// Maximum length of a channel name, characters (LCM_MAX_CHANNEL_NAME_LENGTH).
constexpr uint32_t kMaxChannelSize = 63;

uint64_t big_endian(const uint8_t* bytes, int size) {
  uint64_t value = 0;
  for (int i = 0; i < size; ++i) value = value << 8 | bytes[i];
  return value;
}

void append_big_endian(std::vector<uint8_t>& bytes, uint64_t value, int size) {
  for (int i = size - 1; i >= 0; --i) bytes.push_back(static_cast<uint8_t>(value >> (8 * i)));
}

}  // namespace

LogReader::LogReader(const std::filesystem::path& file) : file_(std::fopen(file.c_str(), "rb")) {
  if (file_ == nullptr) {
    throw Error("cannot open log " + file.string() + ": " + std::strerror(errno));
  }
  std::error_code fault;
  size_ = static_cast<int64_t>(std::filesystem::file_size(file, fault));
  if (fault) throw Error("cannot read log " + file.string() + ": " + fault.message());
}

// The next event with its data.
std::optional<LogEvent> LogReader::next() {
  auto entry = next_entry();
  if (!entry) return std::nullopt;
  auto message = data(entry->offset, entry->size);
  return LogEvent{entry->number, entry->wall_utime, std::move(entry->channel), std::move(message)};
}

std::optional<LogEntry> LogReader::next_entry() {
  // After damage the next event is found by its sync word; the bytes in between are counted.
  const int64_t num_bytes_before = num_bytes_skipped_;
  while (offset_ + kHeaderSize <= size_) {
    if (auto entry = read_entry()) {
      const int64_t num_missing = entry->number - last_number_ - 1;
      const int64_t num_bytes = num_bytes_skipped_ - num_bytes_before;
      // More events than fit are a damaged number.
      if (num_missing > 0 && num_missing <= num_bytes / kHeaderSize) {
        num_events_skipped_ += num_missing;
      }
      last_number_ = entry->number;
      entry->wall_utime = clock_.take(entry->wall_utime, entry->channel, robot_utime(*entry));
      return entry;
    }
    const int64_t begin = offset_;
    skip_to_sync(begin + 1);
    num_bytes_skipped_ += offset_ - begin;
  }
  num_bytes_skipped_ += size_ - offset_;
  offset_ = size_;
  return std::nullopt;
}

bool LogReader::is_event(int64_t offset) const {
  std::array<uint8_t, kHeaderSize> header{};
  if (pread(fileno(file_.get()), header.data(), header.size(), offset) != kHeaderSize) return false;
  const uint64_t channel_size = big_endian(&header[20], 4);
  return big_endian(header.data(), 4) == kSync && channel_size > 0 &&
         channel_size <= kMaxChannelSize;
}

// Messages about a robot begin with their type's fingerprint and the robot's time.
int64_t LogReader::robot_utime(const LogEntry& entry) const {
  std::array<uint8_t, 16> begin{};
  const bool is_about_robot =
      entry.channel.ends_with("_STATE") || entry.channel == kWorldTruthChannel;
  if (!is_about_robot || entry.size < begin.size() ||
      pread(fileno(file_.get()), begin.data(), begin.size(), entry.offset) != begin.size()) {
    return 0;
  }
  return static_cast<int64_t>(big_endian(&begin[8], 8));
}

// Blocks overlap by the length of the sync word less one, so that none is missed between them.
void LogReader::skip_to_sync(int64_t begin) {
  constexpr std::array<uint8_t, 4> kSyncBytes{0xED, 0xA1, 0xDA, 0x01};
  std::vector<uint8_t> block(1 << 16);
  for (offset_ = begin; offset_ + kHeaderSize <= size_;) {
    seek(offset_);
    const size_t num_bytes = std::fread(block.data(), 1, block.size(), file_.get());
    if (num_bytes < kSyncBytes.size()) break;
    const auto end = block.begin() + static_cast<std::ptrdiff_t>(num_bytes);
    const auto found = std::search(block.begin(), end, kSyncBytes.begin(), kSyncBytes.end());
    if (found != end) {
      offset_ += found - block.begin();
      return;
    }
    offset_ += static_cast<int64_t>(num_bytes - kSyncBytes.size() + 1);
  }
  offset_ = size_;
}

std::optional<LogEntry> LogReader::read_entry() {
  std::array<uint8_t, kHeaderSize> header{};
  seek(offset_);
  if (std::fread(header.data(), 1, header.size(), file_.get()) != header.size()) return {};
  const auto channel_size = static_cast<uint32_t>(big_endian(&header[20], 4));
  const auto data_size = static_cast<uint32_t>(big_endian(&header[24], 4));
  // Lengths are checked against the file before memory is taken: a damaged header must not ask for
  // gigabytes.
  const int64_t data_offset = offset_ + kHeaderSize + channel_size;
  if (big_endian(header.data(), 4) != kSync || channel_size == 0 ||
      channel_size > kMaxChannelSize || data_offset + data_size > size_) {
    return {};
  }
  LogEntry entry{static_cast<int64_t>(big_endian(&header[4], 8)),
                 static_cast<int64_t>(big_endian(&header[12], 8)), std::string(channel_size, ' '),
                 data_offset, data_size};
  if (std::fread(entry.channel.data(), 1, channel_size, file_.get()) != channel_size) return {};
  // A name with control bytes is damage, and must not reach a terminal.
  if (std::ranges::any_of(entry.channel, [](unsigned char c) { return c < ' ' || c == 0x7F; })) {
    return {};
  }
  const int64_t end = data_offset + data_size;
  if (end != size_ && !is_event(end)) {
    // This length is wild, or what follows is damaged. The former swallows events.
    const int64_t begin = offset_;
    do {
      skip_to_sync(offset_ + 1);
    } while (offset_ < end && !is_event(offset_));
    const bool swallows_events = offset_ < end;
    offset_ = begin;
    if (swallows_events) return {};
  }
  offset_ = end;
  return entry;
}

std::vector<uint8_t> LogReader::data(int64_t offset, uint32_t size) {
  std::vector<uint8_t> bytes(size);
  seek(offset);
  if (std::fread(bytes.data(), 1, bytes.size(), file_.get()) != bytes.size()) bytes.clear();
  return bytes;
}

void LogReader::seek(int64_t offset) {
  // A seek would discard stdio's buffer; it is skipped while reading sequentially.
  if (std::ftell(file_.get()) != offset) std::fseek(file_.get(), offset, SEEK_SET);
}

std::vector<uint8_t> encode_log_event(const LogEvent& event) {
  std::vector<uint8_t> bytes;
  bytes.reserve(kHeaderSize + event.channel.size() + event.data.size());
  append_big_endian(bytes, kSync, 4);
  append_big_endian(bytes, static_cast<uint64_t>(event.number), 8);
  append_big_endian(bytes, static_cast<uint64_t>(event.wall_utime), 8);
  append_big_endian(bytes, event.channel.size(), 4);
  append_big_endian(bytes, event.data.size(), 4);
  bytes.insert(bytes.end(), event.channel.begin(), event.channel.end());
  bytes.insert(bytes.end(), event.data.begin(), event.data.end());
  return bytes;
}

}  // namespace nao
