#include "tools/bench/link_model.h"

#include <algorithm>
#include <cmath>

namespace nao::bench {

std::optional<double> LinkModel::send(size_t bytes, double now) {
  // Drawn for every packet, so that what happens to one does not depend on the others' fate.
  const bool is_lost = std::uniform_real_distribution<>(0, 1)(random_) < conditions_.loss;
  double sent = next_open(now);
  if (conditions_.rate > 0) {
    const double waiting = (std::max(busy_until_, sent) - sent) * conditions_.rate;
    if (waiting > kMaxWaiting) return std::nullopt;
    busy_until_ = std::max(busy_until_, sent) + static_cast<double>(bytes) / conditions_.rate;
    sent = next_open(busy_until_);
  }
  if (is_lost) return std::nullopt;
  last_arrival_ = std::max(last_arrival_, sent + conditions_.delay);
  return last_arrival_;
}

double LinkModel::next_open(double now) const {
  if (!(conditions_.pause > 0)) return now;
  const double phase = std::fmod(now - start_, conditions_.pause_period);
  const bool is_paused = phase >= conditions_.pause_period - conditions_.pause;
  return is_paused ? now + conditions_.pause_period - phase : now;
}

}  // namespace nao::bench
