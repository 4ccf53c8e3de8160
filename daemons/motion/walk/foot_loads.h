#pragma once

#include <Eigen/Geometry>
#include <array>

#include "daemons/motion/walk/com_reference.h"
#include "daemons/motion/walk/feet.h"
#include "daemons/motion/walk/gait.h"
#include "daemons/motion/walk/servo_feedforward.h"

namespace nao::motion {

/** Input from which the load on the feet is planned. */
struct LoadPlan {
  /** Measured DCM minus the reference's, m, in S. */
  Eigen::Vector2d dcm_error = Eigen::Vector2d::Zero();
  /** Fraction of the weight on the foot that is not the support foot, 0..1. */
  double other_load_ratio = 0;
  bool is_double_support = true;
};

/** Ground reaction forces on left and right foot, in the torso frame.
 *
 * The sum follows from the pendulum, f = m (omega^2 (x - p), g). Each foot carries its load ratio
 * of it. On the support foot it acts at the ZMP, moved by ankle_dcm_gain times the DCM error and
 * clamped to the sole; on the other foot at the nominal point. In double support the ZMP lies
 * between the feet, and each foot is loaded around its nominal point.
 *
 * @param mass  Mass of the robot, kg. @param torso  In the support frame S. */
std::array<FootLoad, 2> plan_foot_loads(const Gait& gait, double mass, const Feet& feet,
                                        const ComReference& reference, const LoadPlan& plan,
                                        const Eigen::Isometry3d& torso);

}  // namespace nao::motion
