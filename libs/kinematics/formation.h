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

/** Where a ball that has left the field is put back (SPL rules, "Kick-in", "Goal Kick", "Corner
 * Kick"), in a team's frame, as far as can be inferred from where it was last seen.
 * @param last_seen  Near where it left the field, m. @param is_own  Whether the team restarts.
 * @param half_field, goal_area  Half of the field's length and width; length and width of the goal
 *   area; m. */
Eigen::Vector2d restart_place(const Eigen::Vector2d& last_seen, bool is_own,
                              const Eigen::Vector2d& half_field, const Eigen::Vector2d& goal_area);

}  // namespace nao
