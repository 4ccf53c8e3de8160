#include "daemons/play/positioner.h"

#include <cmath>

#include "daemons/play/approach.h"

namespace nao::play {
namespace {

/** Hysteresis of the position: the robot stops within the first and walks beyond the second, m and
 * rad. */
constexpr double kInPlace = 0.06;
constexpr double kOutOfPlace = 0.2;
constexpr double kTurned = 0.15;
constexpr double kTurnedAway = 0.4;
/** Duration of a search with the head, s. */
constexpr double kSearchDuration = 4;

}  // namespace

Decision Positioner::step(const Pose2& place, const std::optional<Eigen::Vector2d>& ball,
                          const Situation& situation) {
  const Pose2& feet = situation.robot.feet_in_odometry;
  const double distance = (place.position - feet.position).norm();
  const double turn = std::abs(wrapped(place.heading - feet.heading));
  if (distance < kInPlace && turn < kTurned) is_in_place_ = true;
  if (distance > kOutOfPlace || turn > kTurnedAway) is_in_place_ = false;
  Decision decision;
  decision.phase = PlayPhase::kGuard;
  decision.target = place.position;
  if (!is_in_place_) decision.walk = plan_walk_to(place, feet, constants_.walk_limits);
  if (ball) {
    search_.stop();
    decision.gaze.point = ball;
    return decision;
  }
  // Only the head searches for the ball; the robot does not walk for it.
  decision.reason = Reason("ball-not-in-sight");
  if (!search_.is_active()) search_.start(std::nullopt, situation);
  decision.gaze = search_.step(situation, constants_).gaze;
  if (search_.duration(situation) > kSearchDuration) search_.stop();
  return decision;
}

}  // namespace nao::play
