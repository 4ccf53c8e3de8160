#pragma once

namespace nao::bench {

/** Time for anything that a benchmark waits for, s. Chosen: no measurement, only the end of a
 * benchmark that cannot go on. */
inline constexpr double kDeadline = 60;

}  // namespace nao::bench
