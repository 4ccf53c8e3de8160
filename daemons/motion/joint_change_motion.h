#pragma once

#include <string>
#include <vector>

#include "motion/command.h"
#include "motion/joint_trajectory.h"
#include "motion/motion_generator.h"

namespace nao::motion {

/** Turns single joints to their goals; the others come to rest where they are. */
class JointChangeMotion : public MotionGenerator {
 public:
  /** @param change  Checked: known joints, finite numbers. */
  explicit JointChangeMotion(JointChangeCommand change) : change_(std::move(change)) {}

  /** Targets after the change, clipped to all limits, rad, (num_motors). */
  static std::vector<double> calc_goal(const RobotModel& model, const JointChangeCommand& change,
                                       const std::vector<double>& targets);

  void start(const MotionContext& context, const JointTargets& targets) override;
  Phase step(const MotionContext& context, JointTargets& targets) override;
  Mode mode() const override { return Mode::kMoving; }
  double progress() const override;
  std::string remark() const override { return remark_; }

 private:
  /** Brisk, with the rates that go with it, if none of the joints carries the body. */
  JointTrajectory::Start choose_start(const MotionContext& context,
                                      std::vector<JointRates>& rates) const;

  JointChangeCommand change_;
  JointTrajectory trajectory_;
  double time_ = 0;
  std::string remark_;
};

/** Brings all joints to rest as soon as their accelerations allow. */
class StopMotion : public MotionGenerator {
 public:
  void start(const MotionContext& context, const JointTargets& targets) override;
  Phase step(const MotionContext& context, JointTargets& targets) override;
  Mode mode() const override { return Mode::kMoving; }

 private:
  JointTrajectory trajectory_;
  double time_ = 0;
};

}  // namespace nao::motion
