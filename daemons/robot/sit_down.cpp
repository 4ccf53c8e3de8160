#include "daemons/robot/sit_down.h"

#include "common/smooth_step.h"

namespace nao::robot {
namespace {

/** Start of the motion of arms and of legs, s after the beginning. */
constexpr double kArmsEnd = 0.6;
constexpr double kLegsBegin = 0.3;
constexpr double kLegsEnd = 2.6;

}  // namespace

// The motion leads to the rest posture of robot.yaml; a model without one cannot be used here.
SitDown::SitDown(const RobotModel& model)
    : from_(static_cast<size_t>(model.num_motors())),
      to_(model.find_posture(model.references().rest)->position),
      is_leg_(static_cast<size_t>(model.num_motors())) {
  for (const LegDescription& leg : model.legs()) {
    for (const int joint : leg.joints) {
      const int motor = model.motor_of(joint);
      if (motor >= 0) is_leg_[static_cast<size_t>(motor)] = true;
    }
  }
}

void SitDown::begin(const std::vector<double>& from) {
  from_ = from;
  time_ = 0;
}

void SitDown::step(double dt, std::vector<double>& position) {
  time_ += dt;
  // Arms first, legs later: the arms must be out of the way of the thighs.
  const double arms = smooth_step(time_ / kArmsEnd);
  const double legs = smooth_step((time_ - kLegsBegin) / (kLegsEnd - kLegsBegin));
  for (size_t i = 0; i < position.size(); ++i) {
    position[i] = from_[i] + (is_leg_[i] ? legs : arms) * (to_[i] - from_[i]);
  }
}

}  // namespace nao::robot
