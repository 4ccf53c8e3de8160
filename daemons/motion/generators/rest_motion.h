#pragma once

#include "daemons/motion/generators/motion_generator.h"
#include "daemons/motion/generators/posture_path_motion.h"

namespace nao::motion {

/** Goes to a posture in which the robot needs no torque, and relaxes the motors. */
class RestMotion : public MotionGenerator {
 public:
  /** @param graph, posture  Must outlive this. @param speed  Fraction of the maximum, (0, 1]. */
  RestMotion(const TransitionGraph& graph, const Posture& posture, double speed)
      : path_(graph, posture, speed) {}

  void start(const MotionContext& context, const JointTargets& targets) override {
    path_.start(context, targets);
  }
  Phase step(const MotionContext& context, JointTargets& targets) override;
  bool can_be_replaced() const override { return path_.can_be_replaced(); }
  void finish() override { path_.finish(); }
  Mode mode() const override { return path_.mode(); }
  bool must_stay_upright() const override { return !is_there_ && path_.must_stay_upright(); }
  Reason reason() const override { return path_.reason(); }

 private:
  PosturePathMotion path_;
  bool is_there_ = false;
  /** Time since the motors began to relax, s. */
  double time_ = 0;
};

}  // namespace nao::motion
