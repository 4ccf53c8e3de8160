#include "daemons/motion/generators/rest_motion.h"

#include <algorithm>

namespace nao::motion {
namespace {

constexpr double kRelaxingTime = 1.0;  // s

}  // namespace

MotionGenerator::Phase RestMotion::step(const MotionContext& context, JointTargets& targets) {
  if (!is_there_) {
    const Phase phase = journey_.step(context, targets);
    is_there_ = phase == Phase::kDone;
    return is_there_ ? Phase::kRunning : phase;
  }
  time_ += context.dt;
  const double share = std::max(0.0, 1 - time_ / kRelaxingTime);
  std::fill(targets.stiffness.begin(), targets.stiffness.end(), share);
  return share > 0 ? Phase::kRunning : Phase::kDone;
}

}  // namespace nao::motion
