#pragma once

namespace nao {

/** Who goes first among programs that run ahead of usual ones. */
enum class Turns {
  /** Answers others, strangers among them: the gateway. */
  kServing,
  /** Keeps the robot's time and its balance: nobody who is served may hold it up. */
  kControl
};

/** Asks the system to run this thread, and those that it starts from now on, ahead of all usual
 * ones as soon as what they wait for has come (SCHED_RR, sched(7), at priority 1 for kServing and 2
 * for kControl). For programs that work briefly and often; call it before the bus is opened, which
 * starts a thread. Otherwise a wake-up may wait for the next tick of the kernel, 4 ms at 250 Hz.
 *
 * @return Whether it was granted: to root, or with RLIMIT_RTPRIO (limits.conf(5)) of 1 or more.
 *   kControl needs 2 to go ahead of kServing; with 1 they take turns. */
bool ask_for_prompt_turns(Turns turns);

/** Gives that back, for this thread: for work that does not wait. */
void take_usual_turns();

}  // namespace nao
