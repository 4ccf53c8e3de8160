#pragma once

namespace nao {

/** Tolerance of axes (unit vectors) and positions, m: the numbers of a URDF are rounded. */
constexpr double kLegTolerance = 1e-6;

}  // namespace nao
