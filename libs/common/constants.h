#pragma once

#include <cmath>

namespace nao {

/** Acceleration of gravity, m/s^2. */
constexpr double kGravity = 9.81;

/** A degree, rad. */
constexpr double kDegree = M_PI / 180;

}  // namespace nao
