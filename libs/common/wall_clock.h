#pragma once

#include <cstdint>

namespace nao {

/** Wall clock, microseconds since 1970. For logs and status only; robot time is the messages'
 * utime. */
int64_t wall_utime();

/** Monotonic clock, s since an arbitrary origin. For timeouts and periods. */
double monotonic_seconds();

}  // namespace nao
