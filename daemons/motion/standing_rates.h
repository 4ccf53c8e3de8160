#pragma once

#include <vector>

#include "daemons/motion/generators/joint_trajectory.h"
#include "daemons/motion/generators/motion_generator.h"

namespace nao::motion {

/** Rates at which joints turn while the robot stands: all at a fraction of their maximum speed, the
 * legs' slowed so that the body's own momentum cannot tip it.
 * @param speed  (0, 1]. @return (num_motors). */
std::vector<JointRates> standing_rates(const MotionContext& context, double speed);

/** Rates at which joints come to rest that somebody else's motion has left turning: those that bear
 * no weight almost where they are. @return (num_motors). */
std::vector<JointRates> stopping_rates(const MotionContext& context);

/** Whether a joint lies between the torso and a sole. */
bool carries_body(const MotionContext& context, int motor);

}  // namespace nao::motion
