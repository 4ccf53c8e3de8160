#include "daemons/play/positioner.h"

#include <cmath>

#include "daemons/play/approach.h"

namespace nao::play {
namespace {}  // namespace

Decision Positioner::step(const Pose2& place, const std::optional<Eigen::Vector2d>& ball,
                          const Situation& situation) {
  const Pose2& feet = situation.robot.feet_in_odometry;
  const double distance = (place.position - feet.position).norm();
  const double turn = std::abs(wrapped(place.heading - feet.heading));
  if (distance < parameters_.in_place && turn < parameters_.turned) is_in_place_ = true;
  if (distance > parameters_.out_of_place || turn > parameters_.turned_away) is_in_place_ = false;
  Decision decision;
  decision.phase = PlayPhase::kGuard;
  decision.target = place.position;
  if (!is_in_place_) decision.walk = plan_walk_to(place, feet, constants_);
  if (ball) {
    search_.stop();
    decision.gaze.point = ball;
    return decision;
  }
  // Only the head searches for the ball; the robot does not walk for it.
  decision.reason = Reason("ball-not-in-sight");
  if (!search_.is_active()) search_.start(std::nullopt, situation);
  decision.gaze = search_.step(situation, constants_).gaze;
  if (search_.duration(situation) > parameters_.search_duration) search_.stop();
  return decision;
}

}  // namespace nao::play
