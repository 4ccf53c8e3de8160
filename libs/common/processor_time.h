#pragma once

#include <ctime>

namespace nao {

/** Time of a clock of clock_gettime(2), s. */
inline double clock_seconds(clockid_t clock) {
  timespec time{};
  clock_gettime(clock, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/** Processor time of this thread, s: does not grow while the machine is busy with other things. */
inline double thread_seconds() {
  return clock_seconds(CLOCK_THREAD_CPUTIME_ID);
}

/** Processor time of all threads of this process, s. */
inline double process_seconds() {
  return clock_seconds(CLOCK_PROCESS_CPUTIME_ID);
}

}  // namespace nao
