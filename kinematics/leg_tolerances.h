#pragma once

namespace nao {

/** Tolerance of axes (unit vectors) and positions, m: the numbers of a URDF are rounded. */
constexpr double kLegTolerance = 1e-6;
/** Tolerance of a cosine at the ends of the leg's reach: rounding only. */
constexpr double kCosineTolerance = 1e-12;

}  // namespace nao
