#include "daemons/motion/generators/rest_motion.h"

#include <algorithm>

namespace nao::motion {
namespace {

// Time in which the stiffness falls from 1 to 0, s. Chosen: the body settles onto its joint limits
// without a fall.
constexpr double kRelaxingTime = 1.0;

}  // namespace

MotionGenerator::Phase RestMotion::step(const MotionContext& context, JointTargets& targets) {
  if (!is_there_) {
    const Phase phase = path_.step(context, targets);
    is_there_ = phase == Phase::kDone;
    return is_there_ ? Phase::kRunning : phase;
  }
  // After the path to the rest posture the stiffness falls linearly to 0.
  time_ += context.dt;
  const double stiffness = std::max(0.0, 1 - time_ / kRelaxingTime);
  std::fill(targets.stiffness.begin(), targets.stiffness.end(), stiffness);
  return stiffness > 0 ? Phase::kRunning : Phase::kDone;
}

}  // namespace nao::motion
