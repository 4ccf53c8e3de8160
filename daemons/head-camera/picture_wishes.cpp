#include "daemons/head-camera/picture_wishes.h"

#include <algorithm>

namespace nao {
namespace {

/** How long a wish lasts, s. */
constexpr double kValidity = 2.0;
/** Watchers that are remembered at once; more are a fault of theirs. */
constexpr size_t kMostEntries = 256;
/** So that rounding does not lose a picture: a third added three times is a whole. */
constexpr double kWhole = 1 - 1e-6;

}  // namespace

std::string refuse_wish(const PictureWish& wish) {
  if (wish.camera != "top" && wish.camera != "bottom") {
    return "there is no camera \"" + wish.camera + "\"; it is top or bottom";
  }
  if (wish.width != kFullWidth && wish.width != kFullWidth / 2 && wish.width != kFullWidth / 4) {
    return "pictures are 640, 320 or 160 pixels wide, not " + std::to_string(wish.width);
  }
  if (!(wish.rate >= 1 && wish.rate <= kFastestRate)) {
    return "pictures come 1 to 30 times a second, not " + std::to_string(wish.rate);
  }
  if (wish.quality < 0 || wish.quality > 95) {
    return "JPEG quality is 1 to 95, not " + std::to_string(wish.quality);
  }
  return "";
}

void PictureWishes::add(const std::string& source, const PictureWish& wish, double now) {
  const auto key = std::make_tuple(source, wish.camera, wish.width);
  if (entries_.size() >= kMostEntries && entries_.count(key) == 0) return;
  entries_[key] = {wish, now + kValidity};
}

std::vector<PictureWish> PictureWishes::merged(double now) {
  std::erase_if(entries_, [now](const auto& entry) { return entry.second.until < now; });
  std::map<std::pair<std::string, int>, PictureWish> merged;
  for (const auto& [key, entry] : entries_) {
    const auto [place, is_new] =
        merged.try_emplace({entry.wish.camera, entry.wish.width}, entry.wish);
    if (is_new) continue;
    place->second.rate = std::max(place->second.rate, entry.wish.rate);
    place->second.quality = std::max(place->second.quality, entry.wish.quality);
  }
  std::vector<PictureWish> wishes;
  wishes.reserve(merged.size());
  for (const auto& [key, wish] : merged) wishes.push_back(wish);
  return wishes;
}

std::vector<PictureWish> PictureSchedule::due(const std::vector<PictureWish>& wishes) {
  std::map<std::pair<std::string, int>, double> credit;
  std::vector<PictureWish> due;
  for (const PictureWish& wish : wishes) {
    const auto key = std::make_pair(wish.camera, wish.width);
    const auto known = credit_.find(key);
    // The first picture comes at once.
    double share = known != credit_.end() ? known->second + wish.rate / kFastestRate : 1;
    if (share >= kWhole) {
      due.push_back(wish);
      share -= 1;
    }
    credit[key] = share;
  }
  credit_ = std::move(credit);
  return due;
}

}  // namespace nao
