#pragma once

#include <memory>

#include "daemons/motion/actions/action_script.h"
#include "daemons/motion/estimator/gyroscope_filter.h"
#include "daemons/motion/generators/motion_generator.h"
#include "daemons/motion/walk/gait.h"
#include "daemons/motion/walk/servo_feedforward.h"
#include "kinematics/leg_kinematics.h"

namespace nao::motion {

/** Plays an action that is kept as data: from a stand, through its keyframes, up to a stand again.
 *
 * While both soles carry, the ankles' torque pushes the capture point back over the middle between
 * them, and the gyroscope damps. An action that ends on the ground gets up by itself. */
class ScriptMotion : public MotionGenerator {
 public:
  /** @param script, gait  Must outlive this; the gait gives the ankles' damping.
   * @param stand_up  Path to the stand in which it begins, used if the robot does not stand.
   * @param get_up  Path to a stand from the state in which it ends. */
  ScriptMotion(const RobotModel& model, const ActionScript& script, const Gait& gait,
               std::unique_ptr<MotionGenerator> stand_up, std::unique_ptr<MotionGenerator> get_up);

  void start(const MotionContext& context, const JointTargets& targets) override;
  Phase step(const MotionContext& context, JointTargets& targets) override;
  bool can_be_replaced() const override;
  void finish() override;
  Mode mode() const override;
  bool must_stay_upright() const override;
  double progress() const override;
  Reason reason() const override { return reason_; }

 private:
  enum class Part { kStandingUp, kPlaying, kGettingUp };

  void start_playing(const MotionContext& context, const JointTargets& targets);
  Phase play(const MotionContext& context, JointTargets& targets);
  void balance(const MotionContext& context, JointTargets& targets);

  const RobotModel* model_;
  const ActionScript* script_;
  const Gait* gait_;
  std::unique_ptr<MotionGenerator> stand_up_;
  std::unique_ptr<MotionGenerator> get_up_;
  LegKinematics legs_;
  ServoFeedforward feedforward_;

  Part part_ = Part::kPlaying;
  bool is_finishing_ = false;
  KeyframePlayer player_;
  double time_ = 0;
  GyroscopeFilter gyroscope_;
  Reason reason_;
};

}  // namespace nao::motion
