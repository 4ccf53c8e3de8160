#pragma once

#include <vector>

#include "daemons/referee/referee.h"
#include "robot_model/scene_file.h"

namespace nao::referee {

const RobotSighting* find_robot(const RefereeInput& input, const std::string& name);

/** Where a player stands at the next kick-off, in the field frame. */
Pose2 kick_off_place_of(const MatchPlayer& player, const MatchState& state, const SceneFile& scene);

/** Whether a player may stand there at the next kick-off: on its feet, in its own half, outside the
 * centre circle unless its team kicks off, and not where the ball is put. */
bool is_legal_at_kick_off(const MatchPlayer& player, const RobotSighting& robot,
                          const MatchState& state, const SceneFile& scene);

/** Puts the ball onto its mark, and robots that stand where they may not to their places. */
std::vector<Placement> prepare_kick_off(const RefereeInput& input, const MatchState& state,
                                        const SceneFile& scene);

/** Where a penalised robot stands: beside its own half, at the height of its penalty mark, facing
 * the field. */
Placement penalty_place(const MatchPlayer& player, const SceneFile& scene);

}  // namespace nao::referee
