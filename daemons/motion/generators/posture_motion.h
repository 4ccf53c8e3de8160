#pragma once

#include <vector>

#include "daemons/motion/generators/joint_trajectory.h"
#include "daemons/motion/generators/motion_generator.h"

namespace nao::motion {

/** Greatest difference between a joint's angle and a posture, rad, and the motor of that joint. */
struct PostureDeviation {
  double angle = 0;
  int motor = 0;
};

/** @param position  Measured angles, rad, (num_motors). */
PostureDeviation deviation_from(const Posture& posture, const std::vector<double>& position);

/** Straight line of all joints to a posture, then a time in which they settle.
 *
 * Between the standing and crouching postures hip, knee and ankle turn in proportion, so that the
 * soles stay flat and the center of mass stays over them on the whole line. */
class PostureMotion : public MotionGenerator {
 public:
  /** @param posture  Must outlive this. @param speed  Fraction of the maximum, (0, 1]. */
  PostureMotion(const Posture& posture, double speed) : posture_(&posture), speed_(speed) {}

  void start(const MotionContext& context, const JointTargets& targets) override;
  Phase step(const MotionContext& context, JointTargets& targets) override;
  Mode mode() const override { return Mode::kMoving; }
  double progress() const override;
  Reason reason() const override { return reason_; }

 private:
  const Posture* posture_;
  double speed_;
  JointTrajectory trajectory_;
  double time_ = 0;
  Reason reason_;
};

}  // namespace nao::motion
