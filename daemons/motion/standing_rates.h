#pragma once

#include <vector>

#include "daemons/motion/generators/joint_trajectory.h"
#include "daemons/motion/generators/motion_generator.h"

namespace nao::motion {

/** Rates of the joints of a standing robot: a fraction of their maximum speed, and for the legs
 * less, so that the momentum of the body cannot tip it over.
 * @param speed  (0, 1]. @return (num_motors). */
std::vector<JointRates> standing_rates(const MotionContext& context, double speed);

/** Rates at which joints stop that another motion has left turning. Joints that do not carry the
 * body stop faster. @return (num_motors). */
std::vector<JointRates> stopping_rates(const MotionContext& context);

/** Whether a joint is between the torso and a sole. */
bool carries_body(const MotionContext& context, int motor);

}  // namespace nao::motion
