#include "daemons/motion/commands/walk_overlay.h"

#include <utility>

#include "daemons/motion/generators/joint_change_motion.h"

namespace nao::motion {

void WalkOverlay::start(const Command& command, const MotionContext& context,
                        const JointTargets& start) {
  const auto& request = std::get<JointChangeCommand>(command.request);
  Change change{std::make_unique<JointChangeMotion>(request), command, {}, {}};
  for (const std::string& name : request.joint_names) {
    change.motors.push_back(context.model.find_motor(name));
  }
  change.generator->continue_ramps(unfinished_ramps(context.model));
  change.generator->start(context, start);
  for (const auto& ramp : change.generator->unfinished_ramps(context.model)) {
    change.ramps.push_back(ramp.motor);
  }
  change_ = std::move(change);
}

std::vector<MotionGenerator::StiffnessRamp> WalkOverlay::unfinished_ramps(
    const RobotModel& model) const {
  if (!change_) return {};
  return change_->generator->unfinished_ramps(model);
}

void WalkOverlay::release() {
  change_.reset();
  held_.clear();
  stiffness_.clear();
}

std::optional<Reason> WalkOverlay::step(const MotionContext& context, const JointTargets& last) {
  stiffness_.clear();
  if (!change_) return std::nullopt;
  // The change sees last tick's targets, and only its own joints are taken from what it writes.
  JointTargets changed = last;
  const MotionGenerator::Phase phase = change_->generator->step(context, changed);
  for (int motor : change_->motors) held_[motor] = changed.position[motor];
  for (int motor : change_->ramps) stiffness_[motor] = changed.stiffness[motor];
  if (phase != MotionGenerator::Phase::kDone) return std::nullopt;
  return change_->generator->reason();
}

void WalkOverlay::write(JointTargets& targets) const {
  for (const auto& [motor, angle] : held_) targets.position[motor] = angle;
  for (const auto& [motor, stiffness] : stiffness_) targets.stiffness[motor] = stiffness;
}

}  // namespace nao::motion
