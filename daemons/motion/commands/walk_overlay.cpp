#include "daemons/motion/commands/walk_overlay.h"

#include <utility>

#include "daemons/motion/generators/joint_change_motion.h"

namespace nao::motion {

void WalkOverlay::start(const Command& command, const MotionContext& context,
                        const JointTargets& start) {
  const auto& request = std::get<JointChangeCommand>(command.request);
  Change change{std::make_unique<JointChangeMotion>(request), command, {}};
  for (const std::string& name : request.joint_names) {
    change.motors.push_back(context.model.find_motor(name));
  }
  change.generator->start(context, start);
  change_ = std::move(change);
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
  for (int motor : change_->motors) {
    held_[motor] = changed.position[motor];
    stiffness_[motor] = changed.stiffness[motor];
  }
  if (phase != MotionGenerator::Phase::kDone) return std::nullopt;
  return change_->generator->reason();
}

void WalkOverlay::write(JointTargets& targets) const {
  for (const auto& [motor, angle] : held_) targets.position[motor] = angle;
  for (const auto& [motor, stiffness] : stiffness_) targets.stiffness[motor] = stiffness;
}

}  // namespace nao::motion
