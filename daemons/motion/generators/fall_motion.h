#pragma once

#include <vector>

#include "daemons/motion/generators/motion_generator.h"

namespace nao::motion {

/** Fall reflex: a protective pose that depends on the direction of the fall, at reduced stiffness,
 * until the robot lies still. */
class FallMotion : public MotionGenerator {
 public:
  void start(const MotionContext& context, const JointTargets& targets) override;
  Phase step(const MotionContext& context, JointTargets& targets) override;
  bool can_be_replaced() const override { return false; }
  Mode mode() const override { return Mode::kFalling; }
  bool must_stay_upright() const override { return false; }

 private:
  /** Targets of the protective pose, rad, (num_motors). */
  std::vector<double> pose_;
  double time_ = 0;
  /** Time for which the torso has not turned, s. */
  double time_still_ = 0;
};

}  // namespace nao::motion
