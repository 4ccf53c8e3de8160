#pragma once

#include <Eigen/Core>
#include <optional>

#include "daemons/motion/robot_state.h"

namespace nao::motion {

/** The robot's left, in odometry. */
Eigen::Vector2d left_of(const RobotState& state);

/** Whether a robot moves as fast as only a push moves one that stands. */
bool is_pushed(const RobotState& state);

/** Whether a robot on its feet was pushed so that its capture point is farther outside of its soles
 * than a margin, m. */
bool is_pushed_off(const RobotState& state, double margin);

/** Whether a robot that a policy has brought to rest was pushed off its soles. On one foot it is
 * within a step, in which the capture point leaves the sole without a push. */
bool is_pushed_at_rest(const RobotState& state);

/** Lead of the phase, cycles, at which a robot begins to step after a push: the foot on the side to
 * which it moves swings first. */
double recovery_lead(const RobotState& state);

/** Lead of the phase, cycles, at which the foot swings that a push bears on, and beyond whose outer
 * edge the capture point is: steps of the other one would not bring the robot to rest. Nothing: no
 * such push. @param margin  Beyond that edge, as a fraction of the center of mass's height. */
std::optional<double> find_outward_lead(const RobotState& state, double margin);

/** The margin at which a policy begins such a step. Measured (nao-trial push-course --vx 0.3): at 0
 * a walk withstands up to a tenth less, 0.14 is too late. */
inline constexpr double kOutwardMargin = 0.09;

/** Whether a walk by the gait was pushed so that its next step would not catch the robot.
 * @param velocity  Of the walk, m/s, in the torso's heading frame. */
bool is_walk_pushed(const RobotState& state, const Eigen::Vector3d& velocity);

/** Least time between two such changes of the phase, gait cycles: a step. */
inline constexpr double kOutwardCycles = 0.5;

}  // namespace nao::motion
