#pragma once

namespace nao {

/** Priority class of a program with real-time scheduling. */
enum class RealtimePriority {
  /** SCHED_RR priority 1: programs that serve remote clients (the gateway). */
  kServing,
  /** SCHED_RR priority 2: simulator and motion daemon. They preempt kServing, so that no client
   * request delays a control tick. */
  kControl
};

/** Requests real-time scheduling (SCHED_RR, sched(7)) for the calling thread and the threads that
 * it starts from now on.
 *
 * For programs with short and frequent work: they then preempt all normal processes when they wake
 * up. With normal scheduling a wake-up may be delayed until the next kernel tick, 4 ms at 250 Hz.
 * Call it before the bus is opened, because that starts a thread.
 *
 * @return true if granted: to root, or with RLIMIT_RTPRIO (limits.conf(5)) of at least 1. If the
 *   limit is 1, kControl is reduced to priority 1. */
bool request_realtime_scheduling(RealtimePriority priority);

/** Returns the calling thread to normal scheduling (SCHED_OTHER): for long computations. */
void use_normal_scheduling();

}  // namespace nao
