#include "daemons/motion/generators/posture_motion.h"

#include <algorithm>
#include <cmath>

#include "common/constants.h"
#include "daemons/motion/standing_rates.h"

namespace nao::motion {
namespace {

// Time in which the joints must reach their last targets, s. Chosen; a joint that takes longer is
// blocked.
constexpr double kArrivalTime = 1.5;

}  // namespace

PostureDeviation deviation_from(const Posture& posture, const std::vector<double>& position) {
  PostureDeviation result;
  for (size_t motor = 0; motor < position.size(); ++motor) {
    const double angle = std::abs(position[motor] - posture.position[motor]);
    if (angle > result.angle) result = {angle, static_cast<int>(motor)};
  }
  return result;
}

void PostureMotion::start(const MotionContext& context, const JointTargets& targets) {
  trajectory_ = JointTrajectory(targets.position, targets.velocity, posture_->position,
                                standing_rates(context, speed_));
  time_ = 0;
}

MotionGenerator::Phase PostureMotion::step(const MotionContext& context, JointTargets& targets) {
  time_ += context.dt;
  trajectory_.sample(time_, targets.position);
  if (time_ < trajectory_.duration()) return Phase::kRunning;
  // The targets are at the goal; now the measured angles decide.
  const PostureDeviation deviation = deviation_from(*posture_, context.sensors.position);
  if (deviation.angle <= context.options.tolerance_of(*posture_)) return Phase::kDone;
  if (time_ < trajectory_.duration() + kArrivalTime) return Phase::kRunning;
  reason_ = Reason("posture-not-reached",
                   {context.model.motor_joint(deviation.motor).name,
                    std::to_string(std::lround(deviation.angle / kDegree)), posture_->name});
  return Phase::kFailed;
}

double PostureMotion::progress() const {
  return trajectory_.duration() > 0 ? std::min(1.0, time_ / trajectory_.duration()) : 1.0;
}

}  // namespace nao::motion
