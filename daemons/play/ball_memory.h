#pragma once

#include <optional>

#include "daemons/play/situation.h"

namespace nao::play {

/** Distinguishes a ball from a false detection in a single image: counts how often it was seen near
 * one place. */
class BallMemory {
 public:
  /** @param parameters  Must outlive this. */
  explicit BallMemory(const PlayParameters::BallMemory& parameters) : parameters_(parameters) {}

  /** To be called in every step, with the ball as perception tracks it. */
  void take(const std::optional<Ball>& ball, const Pose2& feet_in_odometry);
  /** The ball of the last take() was seen several times. */
  bool is_confirmed() const;
  /** It was not, but was seen shortly before `time`, so that a look is worthwhile.
   * @param time  Robot time, s. */
  bool is_candidate(double time) const;

 private:
  const PlayParameters::BallMemory& parameters_;
  std::optional<Ball> last_;
  int num_seen_ = 0;
};

}  // namespace nao::play
