#pragma once

#include <Eigen/Core>

#include "kinematics/pose2.h"

namespace nao {

/** A team's view of the field and the field's own frame F (x along team 0's attack, y left) differ
 * by half a turn for team 1. @return The pose of the team's frame in F; its own inverse. */
Pose2 team_in_field(int team);

/** Where a player stands at a kick-off, in its team's frame: x towards the opponents' goal.
 *
 * Number 1 is the striker: at the ball if its team kicks off, otherwise outside the centre circle.
 * The highest number of a team of two or more keeps the goal; the others stand in their own half.
 * @param number  On the shirt, from 1. @param team_size  Players of the team, at least `number`.
 * @param half_field  Half of the field's length and width, m. */
Pose2 kick_off_place(int number, int team_size, bool kicks_off, const Eigen::Vector2d& half_field);

}  // namespace nao
