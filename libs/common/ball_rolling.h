#pragma once

namespace nao {

/** Deceleration of a ball that rolls on carpet, m/s^2: SPL carpet (B-Human Code Release 2025), and
 * that of the simulator's carpet unless a trial changes it (sim/world_options.h). In 6 simulated
 * matches the median is 0.30 at every speed from 0.2 to 2 m/s. A kicked ball first slides, down to
 * 5/7 of its speed: from the speed at the kick it comes as far as with 0.54 m/s^2. */
inline constexpr double kBallRollingDeceleration = 0.3;

}  // namespace nao
