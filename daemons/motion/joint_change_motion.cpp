#include "motion/joint_change_motion.h"

#include <algorithm>
#include <cmath>

#include "motion/joint_limits.h"
#include "motion/standing_rates.h"

namespace nao::motion {
namespace {

// Less than this is rounding, not clipping, rad.
constexpr double kClippingTolerance = 1e-6;

/** The angles that a change asks for before any limit. */
std::vector<double> wished_angles(const RobotModel& model, const JointChangeCommand& change,
                                  const std::vector<double>& targets) {
  std::vector<double> wished = targets;
  for (size_t i = 0; i < change.joint_names.size(); ++i) {
    const int motor = model.find_motor(change.joint_names[i]);
    wished[motor] = change.joint_position[i] + (change.is_relative ? targets[motor] : 0.0);
  }
  return wished;
}

}  // namespace

std::vector<double> JointChangeMotion::calc_goal(const RobotModel& model,
                                                 const JointChangeCommand& change,
                                                 const std::vector<double>& targets) {
  std::vector<double> goal = wished_angles(model, change, targets);
  clip_to_limits(model, goal);
  return goal;
}

void JointChangeMotion::start(const MotionContext& context, const JointTargets& targets) {
  std::vector<JointRates> rates =
      change_.allow_tipping
          ? joint_rates(context.model, change_.speed, context.options.max_acceleration)
          : standing_rates(context, change_.speed);
  const JointTrajectory::Start how = choose_start(context, rates);
  // The joints that are not named stop; the named ones start from where they are.
  std::vector<double> base =
      JointTrajectory::stopping(targets.position, targets.velocity, rates).goal();
  for (const std::string& name : change_.joint_names) {
    const int motor = context.model.find_motor(name);
    base[motor] = targets.position[motor];
  }
  const std::vector<double> wished = wished_angles(context.model, change_, base);
  const std::vector<double> goal = calc_goal(context.model, change_, base);
  for (const std::string& name : change_.joint_names) {
    const int motor = context.model.find_motor(name);
    if (std::abs(goal[motor] - wished[motor]) < kClippingTolerance) continue;
    remark_ += remark_.empty() ? "Clipped to the limit: " : ", ";
    remark_ += name;
  }
  if (!remark_.empty()) remark_ += ".";
  trajectory_ = JointTrajectory(targets.position, targets.velocity, goal, rates, 0, how);
  time_ = 0;
}

JointTrajectory::Start JointChangeMotion::choose_start(const MotionContext& context,
                                                       std::vector<JointRates>& rates) const {
  for (const std::string& name : change_.joint_names) {
    if (carries_body(context, context.model.find_motor(name))) {
      return JointTrajectory::Start::kSmooth;
    }
  }
  for (const std::string& name : change_.joint_names) {
    rates[context.model.find_motor(name)].max_acceleration = context.options.free_acceleration;
  }
  return JointTrajectory::Start::kBrisk;
}

MotionGenerator::Phase JointChangeMotion::step(const MotionContext& context,
                                               JointTargets& targets) {
  time_ += context.dt;
  trajectory_.sample(time_, targets.position);
  return time_ < trajectory_.duration() ? Phase::kRunning : Phase::kDone;
}

double JointChangeMotion::progress() const {
  return trajectory_.duration() > 0 ? std::min(1.0, time_ / trajectory_.duration()) : 1.0;
}

void StopMotion::start(const MotionContext& context, const JointTargets& targets) {
  trajectory_ =
      JointTrajectory::stopping(targets.position, targets.velocity,
                                joint_rates(context.model, 1, context.options.max_acceleration));
  time_ = 0;
}

MotionGenerator::Phase StopMotion::step(const MotionContext& context, JointTargets& targets) {
  time_ += context.dt;
  trajectory_.sample(time_, targets.position);
  return time_ < trajectory_.duration() ? Phase::kRunning : Phase::kDone;
}

}  // namespace nao::motion
