#include "kinematics/formation.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace nao {
namespace {

/** Distance behind the ball of the striker of the team that kicks off, m. Chosen: its feet do not
 * touch it. */
constexpr double kBehindBall = 0.35;
/** Places in halves of the field. Chosen: the striker outside the centre circle (0.24 of 4.5 m are
 * 1.08 m, its radius is 0.75 m), the keeper before its goal, the others side by side. */
constexpr double kStriker = -0.24;
constexpr double kKeeper = -0.92;
constexpr std::array<std::array<double, 2>, 3> kOthers{{{-0.5, 0.4}, {-0.5, -0.4}, {-0.3, 0.75}}};

}  // namespace

Pose2 team_in_field(int team) {
  return {Eigen::Vector2d::Zero(), team == 0 ? 0 : M_PI};
}

Pose2 kick_off_place(int number, int team_size, bool kicks_off, const Eigen::Vector2d& half_field) {
  if (number == 1) {
    return {{kicks_off ? -kBehindBall : kStriker * half_field.x(), 0}, 0};
  }
  if (number == team_size) return {{kKeeper * half_field.x(), 0}, 0};
  const auto& place =
      kOthers[std::min<size_t>(static_cast<size_t>(number) - 2, kOthers.size() - 1)];
  return {{place[0] * half_field.x(), place[1] * half_field.y()}, 0};
}

Eigen::Vector2d restart_place(const Eigen::Vector2d& last_seen, bool is_own,
                              const Eigen::Vector2d& half_field, const Eigen::Vector2d& goal_area) {
  const double end = last_seen.x() > 0 ? 1 : -1;
  const double side = last_seen.y() > 0 ? 1 : -1;
  // The ball has crossed the line to which it was nearest, or beyond which it was.
  const Eigen::Vector2d beyond = last_seen.cwiseAbs() - half_field;
  if (beyond.y() > beyond.x()) {
    return {std::clamp(last_seen.x(), -half_field.x(), half_field.x()), side * half_field.y()};
  }
  const bool is_goal_kick = is_own == (end < 0);
  if (!is_goal_kick) return {end * half_field.x(), side * half_field.y()};
  return {end * (half_field.x() - goal_area.x()), side * 0.5 * goal_area.y()};
}

}  // namespace nao
