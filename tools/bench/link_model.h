#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <random>
#include <string>

namespace nao::bench {

/** What a link does to its packets; the same in both directions. */
struct LinkConditions {
  /** Used in the figures: "loss10". */
  std::string name;
  /** Fraction of the packets that are lost, independently of one another. */
  double loss = 0;
  /** From one end to the other, s. */
  double delay = 0;
  /** Bytes a second; 0: unlimited. */
  double rate = 0;
  /** In every period of `pause_period` s nothing passes for `pause` s; what is sent meanwhile
   * passes afterwards. 0: no pauses. */
  double pause = 0;
  double pause_period = 0;
};

/** One direction of an emulated link: tells when each packet arrives. The same seed and times give
 * the same losses. */
class LinkModel {
 public:
  /** @param start  Beginning of the first period of pauses, s; the pause ends the period. */
  LinkModel(const LinkConditions& conditions, uint32_t seed, double start)
      : conditions_(conditions), random_(seed), start_(start) {}

  /** A packet of so many bytes is sent. @param now  s, never less than in the call before.
   * @return When it arrives, s, never before one that was sent earlier; nothing if it is lost. */
  std::optional<double> send(size_t bytes, double now);

  /** Bytes that may wait before a limited rate; a packet that finds more is lost. Source: 50
   * packets of 1,500 bytes, as small routers have. */
  static constexpr double kMaxWaiting = 75e3;

 private:
  /** First moment from `now` on that is in no pause, s. */
  double next_open(double now) const;

  LinkConditions conditions_;
  std::mt19937 random_;
  double start_;
  double busy_until_ = 0;
  double last_arrival_ = 0;
};

}  // namespace nao::bench
