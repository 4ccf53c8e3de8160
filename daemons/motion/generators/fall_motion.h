#pragma once

#include <string>
#include <vector>

#include "daemons/motion/generators/joint_trajectory.h"
#include "daemons/motion/generators/motion_generator.h"

namespace nao::motion {

/** Protects the robot while it falls: a pose that depends on the direction, then soft joints, until
 * it lies still. */
class FallMotion : public MotionGenerator {
 public:
  void start(const MotionContext& context, const JointTargets& targets) override;
  Phase step(const MotionContext& context, JointTargets& targets) override;
  bool can_be_replaced() const override { return false; }
  Mode mode() const override { return Mode::kFalling; }
  bool means_to_stand() const override { return false; }

 private:
  std::vector<double> pose_;
  double time_ = 0;
  double time_still_ = 0;
};

}  // namespace nao::motion
