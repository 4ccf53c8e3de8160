#pragma once

#include "daemons/play/shot_aim.h"
#include "daemons/play/situation.h"

namespace nao::play {

// What a robot does in a match with a ball before its walking feet. Frame of all: odometry.

/** Farther before the feet than this, m, a ball is not pushed by them. */
inline constexpr double kPushReach = 0.45;

/** Whether a ball lies right to be kicked during the walk and need not go far: far from the goal,
 * or where another robot may come first. */
bool can_kick_in_passing(const Ball& ball, const Aim& aim, const Situation& situation,
                         const Field& field);

/** Whether to walk on with the ball instead of shooting it from here. */
bool can_carry(const Ball& ball, const Aim& aim, const Situation& situation, const Field& field);

/** Whether a ball that is carried shall be carried farther. */
bool may_carry_on(const Ball& ball, const Situation& situation, const Field& field);

}  // namespace nao::play
