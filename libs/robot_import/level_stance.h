#pragma once

#include <optional>
#include <vector>

#include "robot_model/robot_model.h"

namespace nao {

/** Angles at which the soles are level and side by side, the hips lower than at the angles 0, and
 * the center of mass above the soles, for legs of any joints: damped least squares within the
 * limits.
 *
 * Source: K. Levenberg, "A method for the solution of certain non-linear problems in least
 * squares", Quarterly of Applied Mathematics 2(2), 1944.
 * @param bend  How much lower, fraction of the height of the root above the soles.
 * @return rad, (num_motors), motor order; nothing if the legs do not reach such a posture. */
std::optional<std::vector<double>> find_level_stance(const RobotModel& model, double bend);

}  // namespace nao
