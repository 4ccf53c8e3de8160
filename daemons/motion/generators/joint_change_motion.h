#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "daemons/motion/generators/joint_trajectory.h"
#include "daemons/motion/generators/motion_generator.h"
#include "messages/command.h"

namespace nao::motion {

/** Turns single joints to their goals; the others come to rest where they are, each of both in its
 * own time: one that had to arrive together with a slow change would coast far. */
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
  Reason reason() const override { return reason_; }
  /** Targets from the start to the end, rad, each (num_motors); from one to the next no joint turns
   * farther than it must within 5 ms, or 0.05 rad. After start(). */
  std::vector<std::vector<double>> calc_way(const RobotModel& model) const;

 private:
  double duration() const { return std::max(stop_.duration(), trajectory_.duration()); }
  void sample(double time, std::vector<double>& position) const;
  /** Brisk, with the rates that go with it, if none of the joints carries the body. */
  JointTrajectory::Start choose_start(const MotionContext& context,
                                      std::vector<JointRates>& rates) const;

  JointChangeCommand change_;
  /** Of all joints, but those that turn. */
  JointTrajectory stop_;
  /** Of those that turn: the named ones, and those whose limits depend on them. */
  JointTrajectory trajectory_;
  std::vector<int> turning_;
  double time_ = 0;
  Reason reason_;
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
