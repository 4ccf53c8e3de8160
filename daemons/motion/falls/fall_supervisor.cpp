#include "daemons/motion/falls/fall_supervisor.h"

#include <utility>

#include "daemons/motion/transitions/body_state.h"

namespace nao::motion {
namespace {

// Time after a get-up within which a fall is its consequence, s. Chosen: a robot that ends it off
// its balance falls within 1 s.
constexpr double kRelapseTime = 2;

}  // namespace

void FallSupervisor::note_new_fall() {
  // The robot that was seen to fall lies now.
  if (std::exchange(has_fallen_, true)) return;
  num_relapses_ = time_since_up_ < kRelapseTime ? num_relapses_ + 1 : 0;
  time_since_up_ = std::numeric_limits<double>::infinity();
}

void FallSupervisor::begin(const RobotState& state) {
  was_lying_ = is_lying_now(state);
}

FallSupervisor::Action FallSupervisor::update(const RobotState& state, const Activity& activity,
                                              double dt) {
  time_since_up_ += dt;
  // Protection comes before everything: the caller aborts what runs.
  if (predict_fall(state, activity, dt)) {
    monitor_.reset();
    note_new_fall();
    time_fallen_ = 0;
    return Action::kProtect;
  }
  if (activity.is_busy) {
    time_fallen_ = 0;
    return Action::kNone;
  }
  // No motion runs: a robot that lies now and did not before was knocked over.
  const bool lies = is_lying_now(state);
  if (lies && !was_lying_) note_new_fall();
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
  return is_above_seat(*model_, state) &&
         monitor_.update(state, activity.is_walking, dt, activity.walking_tilt);
}

// A motion has ended: one that succeeded (not the fall itself) leaves a known state; one that
// failed while the robot lies after a fall makes it ask for help.
void FallSupervisor::note_end(bool is_done, Ended kind, const RobotState& state) {
  const bool lies = is_lying_now(state);
  if (kind == Ended::kJointChange && has_fallen_ && lies) return;
  if (is_done && kind != Ended::kFall) {
    if (has_fallen_ && !lies) time_since_up_ = 0;
    has_fallen_ = false;
    was_lying_ = lies;
  }
  needs_help_ = !is_done && has_fallen_ && lies;
}

bool FallSupervisor::is_lying_now(const RobotState& state) const {
  return is_lying(state, options_->lying_tilt);
}

}  // namespace nao::motion
