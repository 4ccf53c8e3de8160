#pragma once

#include <memory>

#include "daemons/motion/actions/action_script.h"
#include "daemons/motion/generators/motion_generator.h"
#include "daemons/motion/guards/tipping_guard.h"
#include "daemons/motion/transitions/keyframes.h"

namespace nao::motion {

/** Plays a taught motion: a path to its start posture, then its keyframes as often as it says; then
 * the robot holds the last one.
 *
 * Asked to end, it slows down along its own path until the targets rest, at the first point where a
 * robot on its feet is in static equilibrium; between such points it continues to play. */
class TaughtMotion : public MotionGenerator {
 public:
  /** @param approach  Path to the start posture. @param is_on_feet  Whether that is on the feet. */
  TaughtMotion(const RobotModel& model, std::shared_ptr<const ActionScript> script,
               std::unique_ptr<MotionGenerator> approach, bool is_on_feet);

  void start(const MotionContext& context, const JointTargets& targets) override;
  Phase step(const MotionContext& context, JointTargets& targets) override;
  bool can_be_replaced() const override { return !is_playing_ && approach_->can_be_replaced(); }
  void finish() override;
  Mode mode() const override { return is_playing_ ? Mode::kActing : approach_->mode(); }
  bool must_stay_upright() const override {
    return is_playing_ ? is_on_feet_ : approach_->must_stay_upright();
  }
  double progress() const override;
  Reason reason() const override { return reason_; }
  void describe(MotionState& state) const override;

 private:
  Phase play(const MotionContext& context, JointTargets& targets);
  /** Begins the keyframes, from the present targets. */
  void begin_pass(const MotionContext& context, const JointTargets& targets);
  /** Whether the robot stands safely with the targets of a time, s. */
  bool can_rest_at(double time, const MotionContext& context, const JointTargets& targets);

  std::shared_ptr<const ActionScript> script_;
  std::unique_ptr<MotionGenerator> approach_;
  TippingGuard guard_;
  bool is_on_feet_;
  bool is_playing_ = false;
  bool is_finishing_ = false;
  bool is_stopping_ = false;
  KeyframePlayer player_;
  /** Time along the path, s, and its rate: 1, and falling to 0 while it stops. */
  double time_ = 0;
  double rate_ = 1;
  /** Time since it was asked to end, s. */
  double time_finishing_ = 0;
  /** How often the keyframes have been played. */
  int num_passes_ = 0;
  Reason reason_;
};

}  // namespace nao::motion
