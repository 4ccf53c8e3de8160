#pragma once

#include <cstdint>

#include "daemons/motion/actions/action_script.h"
#include "robot_model/robot_model.h"

namespace nao::trial {

/** A random taught motion of a seed. Odd seeds: keyframes anywhere within the joints' limits. Even
 * seeds: keyframes near one posture, as a person makes them. */
motion::ActionScript draw_taught_motion(const RobotModel& model, uint64_t seed);

/** Number of hand-made motions. */
inline constexpr int kNumGoodMotions = 50;

/** A motion as a careful person makes it, 0 to kNumGoodMotions - 1: waves, arm poses, looks, bows,
 * squats and weight shifts, standing and sitting. Each must be accepted. The names of the joints
 * are those of a NAO; joints that another robot does not have are left out. */
motion::ActionScript make_good_motion(const RobotModel& model, int number);

}  // namespace nao::trial
