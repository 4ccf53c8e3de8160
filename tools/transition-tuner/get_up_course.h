#pragma once

#include <cstdint>
#include <string>

#include "daemons/motion/transitions/transition_graph.h"
#include "sim/closed_loop/closed_loop.h"

namespace nao {

/** Result of a transition graph from one start. */
struct GetUpResult {
  /** Whether it stood at the end of the first try, and went on standing. */
  bool is_up = false;
  /** Time from lying still to standing in StandInit, or to the failure, s. */
  double time = 0;
  /** Greatest height of the upright torso, as a fraction of the standing height. */
  double height = 0;
  /** Mean over the ticks of the greatest torque of a motor, as a fraction of its peak torque. */
  double load = 0;
  /** RMS of the torso's angular acceleration, rad/s^2. */
  double shaking = 0;
};

/** Trials of get-up motions, from lying on one side of the body. Physics, noise and latency are
 * random in each trial. */
class GetUpCourse {
 public:
  enum class Start { kAny, kBelly, kBack, kLeft, kRight };

  explicit GetUpCourse(Start start) : start_(start) {}

  /** @param options  Model, scene, engine and disturbances.
   * @param seed  Seed of all random values. Even: the robot is placed lying; odd: it is pushed
   * over. */
  GetUpResult run(ClosedLoopOptions options, const motion::TransitionGraph& transitions,
                  uint64_t seed) const;

 private:
  Start start_;
};

/** @throws ConfigError  if there is no such start. */
GetUpCourse::Start parse_start(const std::string& name);

}  // namespace nao
