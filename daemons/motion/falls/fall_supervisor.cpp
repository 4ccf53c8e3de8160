#include "daemons/motion/falls/fall_supervisor.h"

#include "daemons/motion/transitions/body_state.h"

namespace nao::motion {

void FallSupervisor::begin(const RobotState& state) {
  was_lying_ = is_lying_now(state);
}

FallSupervisor::Action FallSupervisor::update(const RobotState& state, const Activity& activity,
                                              double dt) {
  // Protection comes before everything: the caller aborts what runs.
  if (predict_fall(state, activity, dt)) {
    monitor_.reset();
    has_fallen_ = true;
    time_fallen_ = 0;
    return Action::kProtect;
  }
  if (activity.is_busy) {
    time_fallen_ = 0;
    return Action::kNone;
  }
  // No motion runs: a robot that lies now and did not before was knocked over.
  const bool lies = is_lying_now(state);
  if (lies && !was_lying_) has_fallen_ = true;
  was_lying_ = lies;
  // Help is needed until a person has put the robot on its feet.
  needs_help_ = needs_help_ && lies;
  if (!has_fallen_) return Action::kNone;
  time_fallen_ += dt;
  // The robot waits on the ground before it gets up, so that the body comes to rest.
  if (!options_->gets_up || needs_help_ || time_fallen_ < options_->get_up_delay) {
    return Action::kNone;
  }
  time_fallen_ = 0;
  return Action::kGetUp;
}

bool FallSupervisor::predict_fall(const RobotState& state, const Activity& activity, double dt) {
  if (has_fallen_ || was_lying_ || !activity.must_stay_upright) return false;
  return is_above_seat(*model_, state) && monitor_.update(state, activity.is_walking, dt);
}

// A motion has ended: one that succeeded (not the fall itself) leaves a known state; one that
// failed while the robot lies after a fall makes it ask for help.
void FallSupervisor::note_end(bool is_done, Ended kind, const RobotState& state) {
  const bool lies = is_lying_now(state);
  if (kind == Ended::kJointChange && has_fallen_ && lies) return;
  if (is_done && kind != Ended::kFall) {
    has_fallen_ = false;
    was_lying_ = lies;
  }
  needs_help_ = !is_done && has_fallen_ && lies;
}

bool FallSupervisor::is_lying_now(const RobotState& state) const {
  return is_lying(state, options_->lying_tilt);
}

}  // namespace nao::motion
