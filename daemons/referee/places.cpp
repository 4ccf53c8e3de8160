#include "daemons/referee/places.h"

#include <algorithm>
#include <cmath>

#include "kinematics/formation.h"

namespace nao::referee {
namespace {

using Eigen::Vector2d;

/** Radius around the mark, m, in which no robot may stand: a foot's length before the torso, the
 * ball, and some room. */
constexpr double kFreeMark = 0.25;
/** Where penalised robots stand: beyond the side line, and apart from one another, m. */
constexpr double kBesideField = 0.35;
constexpr double kPenaltySpacing = 0.7;

}  // namespace

const RobotSighting* find_robot(const RefereeInput& input, const std::string& name) {
  const auto found = std::find_if(input.robots.begin(), input.robots.end(),
                                  [&](const RobotSighting& robot) { return robot.name == name; });
  return found != input.robots.end() ? &*found : nullptr;
}

Pose2 kick_off_place_of(const MatchPlayer& player, const MatchState& state,
                        const SceneFile& scene) {
  const Vector2d half(0.5 * scene.field->length, 0.5 * scene.field->width);
  const auto team_size =
      std::count_if(state.players.begin(), state.players.end(),
                    [&](const MatchPlayer& other) { return other.team == player.team; });
  return team_in_field(player.team) * kick_off_place(player.number, static_cast<int>(team_size),
                                                     player.team == state.kickoff_team, half);
}

bool is_legal_at_kick_off(const MatchPlayer& player, const RobotSighting& robot,
                          const MatchState& state, const SceneFile& scene) {
  const Vector2d position = team_in_field(player.team).inverse() * robot.position;
  const FieldDimensions& field = *scene.field;
  const bool is_in_own_half = position.x() < 0 && position.x() > -0.5 * field.length &&
                              std::abs(position.y()) < 0.5 * field.width;
  const bool is_in_circle = position.norm() < 0.5 * field.centre_circle_diameter;
  return robot.is_upright && is_in_own_half && position.norm() > kFreeMark &&
         (!is_in_circle || player.team == state.kickoff_team);
}

std::vector<Placement> prepare_kick_off(const RefereeInput& input, const MatchState& state,
                                        const SceneFile& scene) {
  std::vector<Placement> placements;
  for (const MatchPlayer& player : state.players) {
    const RobotSighting* robot = find_robot(input, player.robot);
    if (robot == nullptr || player.penalty != Penalty::kNone) continue;
    if (is_legal_at_kick_off(player, *robot, state, scene)) continue;
    placements.push_back({player.robot, kick_off_place_of(player, state, scene)});
  }
  placements.push_back({"", {}});
  return placements;
}

Placement penalty_place(const MatchPlayer& player, const SceneFile& scene) {
  const double end = player.team == 0 ? -1 : 1;
  const FieldDimensions& field = *scene.field;
  const double x =
      0.5 * field.length - field.penalty_mark_distance - kPenaltySpacing * (player.number - 1);
  return {player.robot, {{end * x, 0.5 * field.width + kBesideField}, -M_PI / 2}};
}

}  // namespace nao::referee
