#include "viewer/log_file.h"

#include <algorithm>
#include <map>

#include "common/error.h"

namespace nao {

LogFile::LogFile(const std::filesystem::path& file) : reader_(file) {
  std::map<std::string, uint32_t> known;
  int64_t first_utime = 0;
  while (const auto entry = reader_.next_entry()) {
    if (index_.empty()) first_utime = entry->wall_utime;
    const auto [place, is_new] =
        known.try_emplace(entry->channel, static_cast<uint32_t>(channels_.size()));
    if (is_new) channels_.push_back(entry->channel);
    // Never backwards, even where the clock was set while recording.
    const double time = std::max(1e-6 * static_cast<double>(entry->wall_utime - first_utime),
                                 index_.empty() ? 0.0 : index_.back().time);
    index_.push_back({time, entry->offset, entry->size, place->second});
  }
  if (index_.empty()) throw Error(file.string() + " is no log of lcm-logger, or it is empty");
}

double LogFile::duration() const {
  return index_.back().time;
}

void LogFile::read_place(const Place& place, const Visitor& visit) {
  visit(channels_[place.channel], reader_.data(place.offset, place.size), place.time);
}

size_t LogFile::after(double time) const {
  const auto found = std::upper_bound(index_.begin(), index_.end(), time,
                                      [](double t, const Place& place) { return t < place.time; });
  return static_cast<size_t>(found - index_.begin());
}

void LogFile::read(double from, double to, const Visitor& visit) {
  for (size_t i = after(from); i < after(to); ++i) read_place(index_[i], visit);
}

void LogFile::read_latest(double time, const Visitor& visit) {
  std::vector<bool> is_found(channels_.size(), false);
  std::vector<const Place*> found;
  for (size_t i = after(time); i-- > 0 && found.size() < channels_.size();) {
    if (is_found[index_[i].channel]) continue;
    is_found[index_[i].channel] = true;
    found.push_back(&index_[i]);
  }
  for (auto place = found.rbegin(); place != found.rend(); ++place) read_place(**place, visit);
}

}  // namespace nao
