#include "daemons/play/ball_memory.h"

#include <algorithm>

namespace nao::play {
namespace {}  // namespace

void BallMemory::take(const std::optional<Ball>& ball, const Pose2& feet_in_odometry) {
  if (!ball) {
    last_.reset();
    num_seen_ = 0;
    return;
  }
  if (last_ && ball->seen_time == last_->seen_time) return;
  const double distance = (ball->position - feet_in_odometry.position).norm();
  double agreement = parameters_.agreement + parameters_.agreement_per_distance * distance;
  if (last_) {
    const double elapsed = std::max(0.0, ball->seen_time - last_->seen_time);
    agreement += elapsed * std::max(last_->velocity.norm(), ball->velocity.norm());
  }
  const bool agrees = last_ && (ball->position - last_->position).norm() < agreement;
  num_seen_ = agrees ? num_seen_ + 1 : 1;
  last_ = ball;
}

bool BallMemory::is_confirmed() const {
  return num_seen_ >= parameters_.confirmed;
}

bool BallMemory::is_candidate(double time) const {
  return last_ && !is_confirmed() && time - last_->seen_time < parameters_.doubt;
}

}  // namespace nao::play
