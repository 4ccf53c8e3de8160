#pragma once

#include <utility>
#include <vector>

#include "daemons/motion/generators/joint_trajectory.h"
#include "daemons/motion/generators/motion_generator.h"
#include "messages/command.h"

namespace nao::motion {

/** Turns single joints to their goals, changes their stiffness, and brings the others to rest.
 * Stiffness ramps that an older change has not finished continue.
 *
 * The two groups have separate trajectories: joints that had to arrive together with a slow change
 * would coast far. */
class JointChangeMotion : public MotionGenerator {
 public:
  /** @param change  Well formed (find_fault()). */
  explicit JointChangeMotion(JointChangeCommand change) : change_(std::move(change)) {}

  /** Targets after a change, clipped to all limits, rad, (num_motors). */
  static std::vector<double> calc_goal(const RobotModel& model, const JointChangeCommand& change,
                                       const std::vector<double>& targets);

  void start(const MotionContext& context, const JointTargets& targets) override;
  Phase step(const MotionContext& context, JointTargets& targets) override;
  Mode mode() const override { return Mode::kMoving; }
  double progress() const override;
  Reason reason() const override { return reason_; }
  std::vector<StiffnessRamp> unfinished_ramps(const RobotModel& model) const override;
  void continue_ramps(const std::vector<StiffnessRamp>& ramps) override;

  /** Targets from the start to the end, rad, each (num_motors), for collision checks. From one to
   * the next no joint turns by more than 0.05 rad, or than it does in 5 ms. After start(). */
  std::vector<std::vector<double>> calc_path(const RobotModel& model) const;

 private:
  /** A ramp in progress. */
  struct RunningRamp {
    int motor;
    double from;
    double to;
    /** From the start of this motion, s. */
    double duration;
  };

  /** Ramps that the change asks for. */
  std::vector<StiffnessRamp> own_ramps(const RobotModel& model) const;
  /** Own ramps, and those of older motions for other motors. */
  std::vector<StiffnessRamp> all_ramps(const RobotModel& model) const;
  double duration() const;
  void sample(double time, std::vector<double>& position) const;
  /** Returns a brisk start if none of the named joints carries the body, and sets their rates
   * accordingly. */
  JointTrajectory::Start choose_start(const MotionContext& context,
                                      std::vector<JointRates>& rates) const;
  /** Notes the named joints whose goal was clipped. */
  void note_clipping(const RobotModel& model, const std::vector<double>& commanded,
                     const std::vector<double>& goal);

  JointChangeCommand change_;
  /** Brings the joints that do not turn to rest. */
  JointTrajectory stop_;
  /** Trajectory of the joints that turn: the named ones, and those whose limits depend on them. */
  JointTrajectory trajectory_;
  /** Motors of trajectory_. */
  std::vector<int> turning_;
  /** Ramps of earlier motions, one for each motor. */
  std::vector<StiffnessRamp> continued_;
  std::vector<RunningRamp> stiffness_;
  bool is_started_ = false;
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
