#pragma once

namespace nao {

/** Acceleration of gravity, m/s^2. */
constexpr double kGravity = 9.81;

}  // namespace nao
