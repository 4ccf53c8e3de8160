#pragma once

#include <Eigen/Core>

#include "daemons/motion/walk/feet.h"
#include "daemons/motion/walk/gait.h"

namespace nao::motion {

/** Time before the end of a step, s, in which neither ZMP nor step duration is adapted: the joints
 * would follow too late (see initial_lag in gait.yaml), and the control law divides by e^(omega t)
 * - 1, which goes to zero. Chosen: about twice the lag. */
constexpr double kMinHorizon = 0.05;

/** Moves a point into the range of the zero moment point on a sole (zmp.reach_* in gait.yaml).
 * @param nominal  Nominal zero moment point of the sole, m, same frame. */
Eigen::Vector2d clamp_to_sole(const Gait::Zmp& gait, const Eigen::Vector2d& zmp,
                              const Eigen::Vector2d& nominal);

/** ZMP in single support, m, in S: from the nominal one towards the ZMP that would bring the DCM to
 * its planned end point at the end of the step, clamped to the sole.
 *
 * @param nominal  Nominal point of the support foot, m. @param dcm, end_dcm  Now and at the end of
 * the step, m.
 * @param omega    1/s. @param remaining  Time to the end of the step, s. */
Eigen::Vector2d control_single_support(const Gait::Zmp& gait, const Eigen::Vector2d& nominal,
                                       const Eigen::Vector2d& dcm, const Eigen::Vector2d& end_dcm,
                                       double omega, double remaining);

/** ZMP in double support, m, in S: the one that brings the DCM to a goal, clamped to the rectangle
 * that both nominal points span, extended forward and backward by the reach on a sole.
 * @param remaining  Time until the DCM must be at the goal, s. */
Eigen::Vector2d control_double_support(const Gait::Zmp& gait, const Feet& feet,
                                       const Eigen::Vector2d& dcm, const Eigen::Vector2d& goal,
                                       double omega, double remaining);

}  // namespace nao::motion
