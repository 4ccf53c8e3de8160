#include "daemons/robot/robot_core.h"

namespace nao::robot {

RobotCore::RobotCore(const RobotModel& model, const LolaMap& map, bool starts_itself)
    : map_(map),
      reader_(model, map),
      health_(model.num_motors()),
      safety_(model, map, kLolaPeriod, starts_itself),
      limiter_(model),
      lights_(map) {
  const auto num_motors = static_cast<size_t>(model.num_motors());
  targets_.position.assign(num_motors, 0);
  targets_.stiffness.assign(num_motors, 0);
  next_ = targets_;
  // Both sonars off: they are loud, and nothing uses them yet.
  command_.sonar = {false, false};
}

const Measurement& RobotCore::take_frame(const LolaState& state, int num_periods) {
  const bool is_driven = safety_.phase() == Phase::kDriven;
  // A new phase restarts the count of ticks: the motion daemon then treats the robot as a new one
  // and takes over its targets.
  tick_ = is_driven == was_driven_ ? tick_ + 1 : 0;
  was_driven_ = is_driven;
  reader_.read(state, num_periods * kLolaPeriod);
  // The first targets are the joints' angles, so that nothing moves.
  if (is_first_) targets_.position = reader_.measurement().position;
  is_first_ = false;
  return reader_.measurement();
}

// Answers the last frame. The order is: button and faults, then the safety's targets, and last the
// limiter, which no source of targets can bypass.
const LolaCommand& RobotCore::step(const Input& input) {
  const Measurement& measured = reader_.measurement();
  const Press press = button_.step(measured.is_touched[map_.start_button], kLolaPeriod);
  health_.step(measured, targets_, kLolaPeriod);
  next_ = targets_;
  safety_.step({measured, input.command, press, health_.fault(), input.is_ending}, next_);
  limiter_.limit(targets_.position, kLolaPeriod, next_.position);
  targets_ = next_;
  command_.position = map_.to_lola(targets_.position, true);
  command_.stiffness = map_.to_lola(targets_.stiffness, false);
  lights_.step(eye_state(safety_, input.has_driver, health_.fault()), safety_.phase(), kLolaPeriod,
               command_);
  return command_;
}

double RobotCore::commanded_stiffness(int motor) const {
  // Until the robot is driven it counts as limp for the motion daemon, so that no motion begins.
  if (safety_.phase() != Phase::kDriven) return 0;
  return targets_.stiffness[static_cast<size_t>(motor)];
}

}  // namespace nao::robot
