#include "log_file.h"

#include <algorithm>
#include <array>
#include <map>

#include "common/error.h"

namespace nao {
namespace {

constexpr uint32_t kSync = 0xEDA1DA01;
/** Longest channel name that LCM sends, and a bound for data that no sane log exceeds. */
constexpr uint32_t kLongestChannel = 63;
constexpr uint32_t kMostData = 1u << 28;

uint64_t big_endian(const uint8_t* bytes, int num_bytes) {
  uint64_t value = 0;
  for (int i = 0; i < num_bytes; ++i) value = value << 8 | bytes[i];
  return value;
}

}  // namespace

LogFile::LogFile(const std::filesystem::path& file) : file_(std::fopen(file.c_str(), "rb")) {
  if (file_ == nullptr) throw Error("cannot open log " + file.string());
  const auto file_bytes = static_cast<int64_t>(std::filesystem::file_size(file));
  std::map<std::string, uint32_t> known;
  int64_t first_utime = 0;
  int64_t offset = 0;
  std::array<uint8_t, 28> header{};
  while (std::fread(header.data(), 1, header.size(), file_.get()) == header.size()) {
    const auto utime = static_cast<int64_t>(big_endian(&header[12], 8));
    const auto channel_bytes = static_cast<uint32_t>(big_endian(&header[20], 4));
    const auto data_bytes = static_cast<uint32_t>(big_endian(&header[24], 4));
    if (big_endian(header.data(), 4) != kSync || channel_bytes > kLongestChannel ||
        data_bytes > kMostData) {
      break;
    }
    std::string channel(channel_bytes, ' ');
    if (std::fread(channel.data(), 1, channel_bytes, file_.get()) != channel_bytes) break;
    const int64_t data_offset = offset + static_cast<int64_t>(header.size()) + channel_bytes;
    offset = data_offset + data_bytes;
    if (offset > file_bytes) break;
    if (index_.empty()) first_utime = utime;
    const auto [place, is_new] =
        known.try_emplace(channel, static_cast<uint32_t>(channels_.size()));
    if (is_new) channels_.push_back(channel);
    // Never backwards, even where the clock was set while recording.
    const double time = std::max(1e-6 * static_cast<double>(utime - first_utime),
                                 index_.empty() ? 0.0 : index_.back().time);
    index_.push_back({time, data_offset, data_bytes, place->second});
    std::fseek(file_.get(), offset, SEEK_SET);
  }
  if (index_.empty()) throw Error(file.string() + " is no log of lcm-logger, or it is empty");
}

double LogFile::duration() const {
  return index_.back().time;
}

LogEvent LogFile::read_entry(const Entry& entry) const {
  LogEvent event{entry.time, channels_[entry.channel], std::vector<uint8_t>(entry.data_bytes)};
  std::fseek(file_.get(), entry.offset, SEEK_SET);
  if (std::fread(event.data.data(), 1, event.data.size(), file_.get()) != event.data.size()) {
    event.data.clear();  // the file has shrunk since; nothing decodes from nothing
  }
  return event;
}

size_t LogFile::after(double time) const {
  const auto place = std::upper_bound(index_.begin(), index_.end(), time,
                                      [](double t, const Entry& entry) { return t < entry.time; });
  return static_cast<size_t>(place - index_.begin());
}

void LogFile::read(double from, double to,
                   const std::function<void(const LogEvent&)>& visit) const {
  for (size_t i = after(from); i < after(to); ++i) visit(read_entry(index_[i]));
}

void LogFile::read_latest(double time, const std::function<void(const LogEvent&)>& visit) const {
  std::vector<bool> is_found(channels_.size(), false);
  std::vector<size_t> found;
  for (size_t i = after(time); i-- > 0 && found.size() < channels_.size();) {
    if (is_found[index_[i].channel]) continue;
    is_found[index_[i].channel] = true;
    found.push_back(i);
  }
  for (auto place = found.rbegin(); place != found.rend(); ++place)
    visit(read_entry(index_[*place]));
}

}  // namespace nao
