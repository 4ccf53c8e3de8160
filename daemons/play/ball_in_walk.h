#pragma once

#include "daemons/play/shot_aim.h"
#include "daemons/play/situation.h"

namespace nao::play {

// What a robot does in a match with a ball in front of its walking feet. All is in the odometry
// frame.

/** Whether a ball is well placed for a kick during the walk and need not go far: far from the goal,
 * or where another robot may come first. */
bool can_kick_in_passing(const Ball& ball, const Aim& aim, const Situation& situation,
                         const PlayConstants& constants);

/** Whether to walk on with the ball instead of shooting it from here. */
bool can_carry(const Ball& ball, const Aim& aim, const Situation& situation,
               const PlayConstants& constants);

/** Whether a ball that is being dribbled should be dribbled farther. */
bool may_carry_on(const Ball& ball, const Situation& situation, const PlayConstants& constants);

}  // namespace nao::play
