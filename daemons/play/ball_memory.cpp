#include "daemons/play/ball_memory.h"

#include <algorithm>

namespace nao::play {
namespace {

/** Sightings after which a candidate counts as a ball. Chosen: false balls in two successive images
 * about one place are rare, and a ball at 4 m is seen about twice a second (docs/vision.md). */
constexpr int kConfirmed = 3;
/** Time for which the robot looks at a candidate after it was seen last, s. */
constexpr double kDoubt = 1.2;
/** Distance within which sightings are of one place: m, and its increase for each m of distance,
 * since an error of the camera's tilt moves a distant ball more. */
constexpr double kAgreement = 0.4;
constexpr double kAgreementPerDistance = 0.15;

}  // namespace

void BallMemory::take(const std::optional<Ball>& ball, const Pose2& feet_in_odometry) {
  if (!ball) {
    last_.reset();
    num_seen_ = 0;
    return;
  }
  if (last_ && ball->seen_time == last_->seen_time) return;
  const double distance = (ball->position - feet_in_odometry.position).norm();
  double agreement = kAgreement + kAgreementPerDistance * distance;
  if (last_) {
    const double elapsed = std::max(0.0, ball->seen_time - last_->seen_time);
    agreement += elapsed * std::max(last_->velocity.norm(), ball->velocity.norm());
  }
  const bool agrees = last_ && (ball->position - last_->position).norm() < agreement;
  num_seen_ = agrees ? num_seen_ + 1 : 1;
  last_ = ball;
}

bool BallMemory::is_confirmed() const {
  return num_seen_ >= kConfirmed;
}

bool BallMemory::is_candidate(double time) const {
  return last_ && !is_confirmed() && time - last_->seen_time < kDoubt;
}

}  // namespace nao::play
