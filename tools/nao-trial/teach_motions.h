#pragma once

#include <cstdint>
#include <vector>

#include "daemons/motion/actions/action_script.h"
#include "robot_model/robot_model.h"

namespace nao::trial {

/** A random taught motion of a seed. Odd seeds: keyframes anywhere within the joints' limits. Even
 * seeds: keyframes near one posture, as a person makes them. */
motion::ActionScript draw_taught_motion(const RobotModel& model, uint64_t seed);

/** Motions as a careful person makes them, each of which must be accepted: variants of those in the
 * robot's good_motions.yaml. @throws ModelError  if the robot has none, or the file is damaged. */
std::vector<motion::ActionScript> make_good_motions(const RobotModel& model);

}  // namespace nao::trial
