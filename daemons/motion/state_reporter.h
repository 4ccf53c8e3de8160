#pragma once

#include <optional>

#include "daemons/motion/commands/command_arbiter.h"
#include "daemons/motion/generators/motion_generator.h"
#include "daemons/motion/joint_targets.h"
#include "daemons/motion/motion_state.h"
#include "messages/mode.h"

namespace nao::motion {

/** Builds the motion state, and decides when it is due: at each change, and once a period. */
class StateReporter {
 public:
  /** @param period  Period of the reports while nothing changes, s. */
  explicit StateReporter(double period) : period_(period) {}

  /** Input from which the state is built. */
  struct Inputs {
    /** Measurements and estimate; the last known ones while there is no robot. */
    const MotionContext& context;
    const JointTargets& targets;
    const CommandArbiter& commands;
    Mode mode;
    bool needs_help;
  };

  /** One control step. @param dt  Time since the last one, s. @return The state, if it is due. */
  std::optional<MotionState> update(const Inputs& inputs, double dt);

  /** As of the last update(). */
  const MotionState& state() const { return state_; }

 private:
  double period_;
  /** s. */
  double time_since_report_ = 0;
  MotionState state_;
};

}  // namespace nao::motion
