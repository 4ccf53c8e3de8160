#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "daemons/motion/generators/joint_trajectory.h"
#include "daemons/motion/generators/motion_generator.h"
#include "daemons/motion/policy_record.h"
#include "policy/policy.h"
#include "policy/policy_runner.h"

namespace nao::motion {

/** A motion by a policy: stands up, goes to the policy's default angles, lets the policy move the
 * robot, and returns to the stand. A get-up begins with the policy at once, as does push recovery.
 *
 * When the policy must not go on it returns to the stand by itself, and fails with the reason. */
class PolicyMotion : public MotionGenerator {
 public:
  /** @param model, policy  Must outlive this; the policy has no fault.
   * @param stand_up, end  Paths to the stand, before and after. Without the first one the policy
   *                       moves the robot at once: its push recovery.
   * @param command        Of a walk.
   * @param on_fault       Called when the policy must not go on. */
  PolicyMotion(const RobotModel& model, const Policy& policy,
               std::unique_ptr<MotionGenerator> stand_up, std::unique_ptr<MotionGenerator> end,
               const WalkCommand& command, std::function<void()> on_fault);

  void start(const MotionContext& context, const JointTargets& targets) override;
  Phase step(const MotionContext& context, JointTargets& targets) override;
  bool can_be_replaced() const override;
  void finish() override { is_finishing_ = true; }
  bool adopt(const Command& command) override;
  double progress() const override;
  Mode mode() const override;
  bool must_stay_upright() const override;
  std::optional<double> fall_tilt() const override;
  Reason reason() const override { return reason_; }
  void describe(MotionState& state) const override;
  Reason note_fall() override;
  const PolicyRecord* policy_record() const override { return has_record_ ? &record_ : nullptr; }

 private:
  /** In this order; while it fades, the targets change from the policy's to its default angles. */
  enum class Stage { kStandingUp, kApproaching, kRunning, kFading, kReturning, kEnding };

  PolicyManifest::Kind kind() const { return policy_->manifest->kind; }
  bool is_policy_moving() const { return stage_ == Stage::kRunning || stage_ == Stage::kFading; }
  void approach(const MotionContext& context, const JointTargets& targets);
  void begin_policy(const JointTargets& targets);
  void begin_recovery(const RobotState& state, const JointTargets& targets);
  /** A robot that the policy has brought to rest, or that is on the way to its stand, is pushed so
   * that it must step. */
  bool is_pushed_again(const RobotState& state) const;
  void return_to_stand(const MotionContext& context, const JointTargets& targets);
  /** Lets the robot's own motions finish. */
  void give_up(const std::string& why);
  /** The same, and the policy must not move the robot again. */
  void fail(const std::string& why);
  /** @return Whether the policy still moves the robot. */
  bool run(const MotionContext& context, JointTargets& targets);
  void steer(const MotionContext& context);
  /** Whether the motion may end now: a walk that stands, a get-up that is up, an action whose time
   * is over. */
  bool is_over(const MotionContext& context, const JointTargets& targets);
  /** The ready posture was not reached, since the soles of the standing robot do not slide. */
  bool has_ended_standing(const RobotState& state) const;
  void record();
  PolicyInput input_of(const MotionContext& context) const;

  const Policy* policy_;
  PolicyRunner runner_;
  std::unique_ptr<MotionGenerator> stand_up_;
  std::unique_ptr<MotionGenerator> end_;
  WalkCommand command_;
  std::function<void()> on_fault_;
  Stage stage_ = Stage::kStandingUp;
  bool is_finishing_ = false;
  /** Steps in place after a push. */
  bool is_recovering_ = false;
  /** Has stepped in place at its end, since its feet were too far apart. */
  bool has_closed_stance_ = false;
  /** Time in this stage, s; since the last walk command; for which the end's condition holds; and
   * without a foot on the ground. */
  double time_ = 0;
  double age_ = 0;
  double time_at_rest_ = 0;
  double time_in_air_ = 0;
  /** Since a push changed which foot swings, gait cycles. */
  double cycles_since_outward_ = 0;
  /** Velocity that the policy is commanded. */
  Eigen::Vector3d velocity_ = Eigen::Vector3d::Zero();
  JointTrajectory trajectory_;
  /** Targets when the policy began, rad, motor order. */
  std::vector<double> begin_;
  /** The policy must not go on. */
  bool has_failed_ = false;
  Reason reason_;
  PolicyRecord record_;
  bool has_record_ = false;
};

}  // namespace nao::motion
