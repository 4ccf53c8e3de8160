#pragma once

#include <algorithm>

#include "daemons/motion/generators/motion_generator.h"
#include "daemons/motion/transitions/keyframes.h"

namespace nao::motion {

/** Plays a keyframe sequence once, as an action: wave. */
class SequenceMotion : public MotionGenerator {
 public:
  /** @param sequence  Must outlive this. */
  explicit SequenceMotion(const KeyframeSequence& sequence) : sequence_(&sequence) {}

  void start(const MotionContext& context, const JointTargets& targets) override {
    player_ = KeyframePlayer(context.model, *sequence_, targets.position, 1.0);
    time_ = 0;
  }
  Phase step(const MotionContext& context, JointTargets& targets) override {
    time_ += context.dt;
    player_.sample(time_, targets.position, targets.stiffness);
    return time_ < player_.duration() ? Phase::kRunning : Phase::kDone;
  }
  Mode mode() const override { return Mode::kActing; }
  double progress() const override {
    return player_.duration() > 0 ? std::min(1.0, time_ / player_.duration()) : 1.0;
  }

 private:
  const KeyframeSequence* sequence_;
  KeyframePlayer player_;
  /** Time since the start, s. */
  double time_ = 0;
};

}  // namespace nao::motion
