#pragma once

#include <vector>

#include "tools/nao-trial/scenario.h"
#include "tools/nao-trial/trial_perception.h"

namespace nao::trial {

/** Stands still in StandInit. */
Scenario stand_scenario();
/** Moves from every posture to every other one. */
Scenario posture_graph_scenario();
/** Walks at one velocity, then stands. Fails below half of the velocity. */
Scenario walk_scenario();
/** Walks straight ahead at the maximum speed. */
Scenario sprint_scenario();
/** A joystick session: random starts, stops, reversals, diagonals and turns. */
Scenario joystick_scenario();
/** Walks to random poses by odometry. */
Scenario move_to_scenario();
/** Kicks a ball; odd seeds with the left foot. With half of the seeds the robot sees the ball, with
 * every fifth one the ball lies beside the kick, which the result of the command must tell. */
Scenario kick_scenario();
/** Kicks a ball in passing and walks on. */
Scenario walk_kick_scenario();
/** A goalkeeper: blocks, or dives to one side and gets up. */
Scenario block_scenario();
/** Turns random joints by random angles; the robot must not tip over or collide with itself, and no
 * target may jump. */
Scenario joints_scenario();
/** Pushes the torso in eight directions, in degrees to the left of straight ahead: the greatest
 * impulse that the robot withstands standing or, if a velocity is commanded, walking, at the time
 * that is worst for it. */
Scenario push_course_scenario();
/** Pushes the torso ten times, from random directions, 1 to 5 s apart: the greatest impulse that
 * the robot withstands each time. */
Scenario pushes_scenario();
/** Gets up after a push, or from a random lying pose. */
Scenario get_up_scenario();
/** Sends random commands in every mode, pushes the robot over, and restarts the motion core. */
Scenario commands_scenario();
/** Walks, changes postures and turns joints without a push: every fall prediction is a false alarm.
 */
Scenario alarms_scenario();
/** Checks random taught motions as nao-motion-files does, plays those that it accepts with other
 * draws of the disturbances, and those that it refuses, too, to count those that were refused
 * without need. */
Scenario teach_scenario();
/** The same with hand-made motions, seeds 0 to 49: none may be refused. */
Scenario teach_good_scenario();

/** PerceptionModel with its usual errors. */
PerceptionFactory perception_model();
/** A scenario on the field. Its name and summary tell a perception without rendered images. */
Scenario with_perception(Scenario scenario, bool is_rendered);
/** Scores, with ball and robot anywhere in the robot's own half. */
Scenario score_scenario(bool is_rendered, const PerceptionFactory& perception);
/** Keeps the goal against one shot. */
Scenario keep_goal_scenario(bool is_rendered, const PerceptionFactory& perception);
/** A match of two teams of two that play by themselves, with a referee: two halves. */
Scenario match_scenario(bool is_rendered, const PerceptionFactory& perception);
/** Walks about the field as a driver would, and compares the estimated pose with the true one; then
 * is placed elsewhere several times. @param is_rendered  nao-vision's perception on rendered
 * images, or detections by FieldErrorModel. */
Scenario localise_scenario(bool is_rendered);

/** The scenarios of every build, in the order in which --help lists them. */
std::vector<Scenario> scenarios();
/** Those that need OpenCV or the renderer. */
std::vector<Scenario> vision_scenarios();

}  // namespace nao::trial
