#pragma once

namespace nao::bench {

/** Timeout of every wait of a benchmark, s. Chosen: it measures nothing and only ends a benchmark
 * that cannot continue. */
inline constexpr double kDeadline = 60;

}  // namespace nao::bench
