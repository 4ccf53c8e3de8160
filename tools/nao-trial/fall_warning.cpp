#include "tools/nao-trial/fall_warning.h"

namespace nao::trial {
namespace {

/** Any part of the robot except its feet touches the floor. */
bool touches_floor_with_body(ClosedLoop& trial) {
  const RobotModel& model = trial.model();
  const int left_foot = model.find_body(model.left_sole());
  const int right_foot = model.find_body(model.right_sole());
  for (const sim::Contact& contact : trial.world().contacts()) {
    if (contact.a.kind != sim::Surface::Kind::kFloor &&
        contact.b.kind != sim::Surface::Kind::kFloor) {
      continue;
    }
    const sim::Surface& body = contact.a.kind == sim::Surface::Kind::kRobot ? contact.a : contact.b;
    const int touching = model.find_body(body.link);
    if (touching != left_foot && touching != right_foot) return true;
  }
  return false;
}

}  // namespace

void FallWarning::look(ClosedLoop& trial) {
  if (touched_) return;
  if (!told_ && trial.core().motion_state().mode == Mode::kFalling) told_ = trial.time();
  if (touches_floor_with_body(trial)) touched_ = trial.time();
}

// -1: the robot touched the ground without a warning.
std::optional<double> FallWarning::warning() const {
  if (!touched_) return std::nullopt;
  return told_ ? *touched_ - *told_ : -1.0;
}

}  // namespace nao::trial
