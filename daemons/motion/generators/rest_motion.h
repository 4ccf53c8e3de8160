#pragma once

#include <string>

#include "daemons/motion/generators/journey_motion.h"
#include "daemons/motion/generators/motion_generator.h"

namespace nao::motion {

/** Goes to a posture in which the robot rests, and lets the motors become limp. */
class RestMotion : public MotionGenerator {
 public:
  /** @param graph, posture  Must outlive this. */
  RestMotion(const TransitionGraph& graph, const Posture& posture, double speed)
      : journey_(graph, posture, speed) {}

  void start(const MotionContext& context, const JointTargets& targets) override {
    journey_.start(context, targets);
  }
  Phase step(const MotionContext& context, JointTargets& targets) override;
  bool can_be_replaced() const override { return journey_.can_be_replaced(); }
  void finish() override { journey_.finish(); }
  Mode mode() const override { return journey_.mode(); }
  bool means_to_stand() const override { return !is_there_ && journey_.means_to_stand(); }
  Reason reason() const override { return journey_.reason(); }

 private:
  JourneyMotion journey_;
  bool is_there_ = false;
  double time_ = 0;
};

}  // namespace nao::motion
