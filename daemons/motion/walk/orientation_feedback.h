#pragma once

#include <vector>

#include "daemons/motion/walk/feet.h"
#include "daemons/motion/walk/gait.h"
#include "daemons/motion/walk/walk_observer.h"
#include "kinematics/leg_kinematics.h"

namespace nao::motion {

/** Adds joint angles that counteract rotation and tilt of the torso: proportional to its angular
 * velocity at ankles and hips, to its tilt at the ankles. They apply to the feet on the ground.
 *
 * @param tilt_scale  Factor on the tilt's part, 0..1.
 * @param offset      Added to, rad, (num_motors). */
void add_orientation_feedback(const Gait::Orientation& gains, const LegKinematics& legs,
                              const WalkObserver& measured, bool support_is_left,
                              bool is_double_support, double tilt_scale,
                              std::vector<double>& offset);

}  // namespace nao::motion
