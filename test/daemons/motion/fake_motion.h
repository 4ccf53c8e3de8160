#pragma once

#include "daemons/motion/generators/motion_generator.h"

namespace nao::motion {

/** A motion that does what a test sets. */
class FakeMotion : public MotionGenerator {
 public:
  /** State that the test sets and reads. */
  struct Script {
    Phase phase = Phase::kRunning;
    bool can_be_replaced = true;
    Mode mode = Mode::kMoving;
    bool adopts = false;
    Strike strike = Strike::kNone;
    Reason reason;
    int num_starts = 0;
    int num_finishes = 0;
  };

  explicit FakeMotion(Script& script) : script_(&script) {}

  void start(const MotionContext& /*context*/, const JointTargets& /*targets*/) override {
    ++script_->num_starts;
  }
  Phase step(const MotionContext& /*context*/, JointTargets& /*targets*/) override {
    return script_->phase;
  }
  bool can_be_replaced() const override { return script_->can_be_replaced; }
  void finish() override { ++script_->num_finishes; }
  bool adopt(const Command& /*command*/) override { return script_->adopts; }
  Strike strike() const override { return script_->strike; }
  Mode mode() const override { return script_->mode; }
  Reason reason() const override { return script_->reason; }

 private:
  Script* script_;
};

}  // namespace nao::motion
