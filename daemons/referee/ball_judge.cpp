#include "daemons/referee/ball_judge.h"

#include <cmath>

#include "common/error.h"

namespace nao::referee {

std::optional<BallExit> judge_ball(const Eigen::Vector3d& ball, std::optional<int> last_team,
                                   const SceneFile& scene) {
  if (!scene.field || !scene.goals || !scene.ball) {
    throw ConfigError("the scene " + scene.name + " has no field with goals and a ball");
  }
  const FieldDimensions& field = *scene.field;
  const GoalDimensions& goals = *scene.goals;
  const double beyond = 0.5 * field.line_width + scene.ball->radius;
  const double half_length = 0.5 * field.length;
  const double half_width = 0.5 * field.width;
  const double end = ball.x() > 0 ? 1 : -1;
  const double side = ball.y() > 0 ? 1 : -1;
  // Team 0 attacks the goal at positive x.
  const int attacker = end > 0 ? 0 : 1;
  if (std::abs(ball.x()) > half_length + beyond) {
    const double opening = 0.5 * (goals.post_distance - goals.post_diameter);
    const double height = goals.crossbar_height - 0.5 * goals.post_diameter;
    if (std::abs(ball.y()) < opening && ball.z() < height) return BallExit{attacker};
    BallExit exit;
    const bool is_goal_kick = last_team.value_or(attacker) == attacker;
    exit.kind = is_goal_kick ? KickKind::kGoalKick : KickKind::kCornerKick;
    exit.restart_team = is_goal_kick ? 1 - attacker : attacker;
    exit.restart = is_goal_kick ? Eigen::Vector2d(end * (half_length - field.goal_area_length),
                                                  side * 0.5 * field.goal_area_width)
                                : Eigen::Vector2d(end * half_length, side * half_width);
    return exit;
  }
  if (std::abs(ball.y()) > half_width + beyond) {
    BallExit exit;
    // Without a touch it went out by itself: the defenders restart.
    exit.restart_team = 1 - last_team.value_or(attacker);
    exit.restart = {ball.x(), side * half_width};
    return exit;
  }
  return std::nullopt;
}

}  // namespace nao::referee
