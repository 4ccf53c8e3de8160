#include "viewer/log_file.h"

#include <algorithm>
#include <map>

#include "common/error.h"

namespace nao::viewer {

LogFile::LogFile(const std::filesystem::path& file) : reader_(file) {
  std::map<std::string, uint32_t> known;
  int64_t first_utime = 0;
  while (const auto entry = reader_.next_entry()) {
    if (index_.empty()) first_utime = entry->wall_utime;
    const auto [place, is_new] =
        known.try_emplace(entry->channel, static_cast<uint32_t>(channels_.size()));
    if (is_new) channels_.push_back(entry->channel);
    // Times never decrease, even if the wall clock was set back while recording.
    const double time = std::max(1e-6 * static_cast<double>(entry->wall_utime - first_utime),
                                 index_.empty() ? 0.0 : index_.back().time);
    index_.push_back({time, entry->offset, entry->size, place->second});
  }
  if (index_.empty()) {
    throw Error(file.string() + " contains no message: it is empty or not a log of lcm-logger");
  }
}

double LogFile::duration() const {
  return index_.back().time;
}

void LogFile::visit_entry(const Entry& entry, const Visitor& visit) {
  visit(channels_[entry.channel], reader_.data(entry.offset, entry.size), entry.time);
}

size_t LogFile::first_after(double time) const {
  const auto found = std::upper_bound(index_.begin(), index_.end(), time,
                                      [](double t, const Entry& entry) { return t < entry.time; });
  return static_cast<size_t>(found - index_.begin());
}

void LogFile::read(double from, double to, const Visitor& visit) {
  for (size_t i = first_after(from); i < first_after(to); ++i) visit_entry(index_[i], visit);
}

void LogFile::read_latest(double time, const Visitor& visit) {
  // Searches backwards until every channel is found.
  std::vector<bool> is_found(channels_.size(), false);
  std::vector<const Entry*> found;
  for (size_t i = first_after(time); i-- > 0 && found.size() < channels_.size();) {
    if (is_found[index_[i].channel]) continue;
    is_found[index_[i].channel] = true;
    found.push_back(&index_[i]);
  }
  for (auto entry = found.rbegin(); entry != found.rend(); ++entry) visit_entry(**entry, visit);
}

}  // namespace nao::viewer
