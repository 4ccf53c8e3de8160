#pragma once

#include <Eigen/Core>
#include <optional>

#include "robot_model/scene_file.h"

namespace nao::referee {

/** Kicks that one team has for itself. */
enum class KickKind { kKickOff, kKickIn, kGoalKick, kCornerKick };

/** The ball has passed a line of the field as a whole. */
struct BallExit {
  /** The team that has scored; nothing: no goal. */
  std::optional<int> goal_of{};
  /** Without a goal: the team that restarts, and from where, m, in the field frame. */
  int restart_team = 0;
  Eigen::Vector2d restart = Eigen::Vector2d::Zero();
  KickKind kind = KickKind::kKickIn;
};

/** Judges whether the ball is in the field.
 *
 * A ball is out, or in the goal, when it is completely beyond the outer edge of the line (SPL
 * rules, "Ball in and out of play"). It comes back on the side line where it left it; at the end of
 * the field on the corner of the goal area if the attackers touched it last (goal kick), on the
 * field's corner if the defenders did (corner kick).
 * @param ball  Center, m, in the field frame. @param last_team  That touched it last; nothing:
 * none.
 * @throws ConfigError  if the scene has no field, goals and ball. */
std::optional<BallExit> judge_ball(const Eigen::Vector3d& ball, std::optional<int> last_team,
                                   const SceneFile& scene);

}  // namespace nao::referee
