#pragma once

#include <cstdint>

namespace nao {

/** Wall clock, microseconds since 1970. For logs and status only: robot time comes in messages. */
int64_t wall_utime();

/** Clock that never jumps, seconds since some start. For time-outs and pacing. */
double monotonic_seconds();

}  // namespace nao
