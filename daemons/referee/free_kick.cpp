#include "daemons/referee/free_kick.h"

#include <algorithm>
#include <cmath>

#include "daemons/referee/places.h"

namespace nao::referee {
namespace {

using Eigen::Vector2d;

/** Time that a team has for its kick, s (HSL: GameController, config/small_foundation). */
constexpr double kKickOffTime = 10;
constexpr double kFreeKickTime = 45;
/** The ball has clearly moved by this, m. Chosen: half of its diameter. */
constexpr double kMoved = 0.05;
/** Time in which an opponent goes away, s. The rules say at once; chosen: a NAO turns and walks
 * the radius in it. */
constexpr double kTimeToLeave = 5;
/** How far it may be in the area, m: only what is clear is judged (HSL). Chosen: half of a NAO's
 * width. */
constexpr double kTolerance = 0.15;

}  // namespace

bool FreeKick::is_too_near(const Vector2d& place, const SceneFile& scene) const {
  const FieldDimensions& field = *scene.field;
  const Vector2d half(0.5 * field.length, 0.5 * field.width);
  // The end that the kicking team attacks, where its opponents' goal is.
  const double attack = team_ == 0 ? 1 : -1;
  const bool is_on_goal_line = attack * place.x() > half.x() - kTolerance &&
                               std::abs(place.y()) < 0.5 * scene.goals->post_distance;
  if (is_on_goal_line) return false;
  if (kind_ == KickKind::kGoalKick) {
    return -attack * place.x() > half.x() - field.penalty_area_length + kTolerance &&
           std::abs(place.y()) < 0.5 * field.penalty_area_width - kTolerance;
  }
  return (place - ball_).norm() < 0.5 * field.centre_circle_diameter - kTolerance;
}

FreeKick::Judgement FreeKick::step(double dt, const RefereeInput& input,
                                   const std::vector<MatchPlayer>& players,
                                   const SceneFile& scene) {
  Judgement judgement;
  age_ += dt;
  std::vector<std::pair<std::string, double>> near;
  for (const MatchPlayer& player : players) {
    const RobotSighting* robot = find_robot(input, player.robot);
    if (robot == nullptr || player.team == team_ || player.penalty != Penalty::kNone) continue;
    if (robot->touches_ball) {
      judgement.offenders.push_back(player.robot);
      judgement.is_retaken = true;
      continue;
    }
    // A robot that gets up cannot walk away.
    if (!robot->is_upright || !is_too_near(robot->position, scene)) continue;
    const auto before = std::find_if(
        near_.begin(), near_.end(), [&](const auto& entry) { return entry.first == player.robot; });
    const double time = dt + (before != near_.end() ? before->second : 0);
    near.emplace_back(player.robot, time);
    if (time > kTimeToLeave) judgement.offenders.push_back(player.robot);
  }
  near_ = std::move(near);
  const bool has_moved = (input.ball.head<2>() - ball_).norm() > kMoved;
  judgement.is_over =
      !judgement.is_retaken &&
      (has_moved || age_ > (kind_ == KickKind::kKickOff ? kKickOffTime : kFreeKickTime));
  return judgement;
}

}  // namespace nao::referee
