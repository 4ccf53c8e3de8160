#include "daemons/motion/generators/joint_change_motion.h"

#include <algorithm>
#include <cmath>

#include "daemons/motion/guards/joint_limits.h"
#include "daemons/motion/standing_rates.h"

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
  stop_ = JointTrajectory::stopping(targets.position, targets.velocity, stopping_rates(context));
  std::vector<double> base = stop_.goal();
  for (const std::string& name : change_.joint_names) {
    const int motor = context.model.find_motor(name);
    base[motor] = targets.position[motor];
  }
  const std::vector<double> wished = wished_angles(context.model, change_, base);
  const std::vector<double> goal = calc_goal(context.model, change_, base);
  std::string clipped;
  for (const std::string& name : change_.joint_names) {
    const int motor = context.model.find_motor(name);
    if (std::abs(goal[motor] - wished[motor]) < kClippingTolerance) continue;
    clipped += (clipped.empty() ? "" : ", ") + name;
  }
  if (!clipped.empty()) reason_ = Reason("clipped-to-limits", {clipped});
  std::vector<double> start = goal;
  std::vector<double> velocity(goal.size(), 0.0);
  turning_.clear();
  for (int motor = 0; motor < context.model.num_motors(); ++motor) {
    const std::string& name = context.model.motor_joint(motor).name;
    const auto& names = change_.joint_names;
    const bool is_named = std::find(names.begin(), names.end(), name) != names.end();
    if (!is_named && goal[motor] == base[motor]) continue;
    turning_.push_back(motor);
    start[motor] = targets.position[motor];
    velocity[motor] = targets.velocity[motor];
  }
  trajectory_ = JointTrajectory(start, velocity, goal, rates, 0, how);
  time_ = 0;
}

void JointChangeMotion::sample(double time, std::vector<double>& position) const {
  stop_.sample(time, position);
  std::vector<double> turned;
  trajectory_.sample(time, turned);
  for (int motor : turning_) position[motor] = turned[motor];
}

std::vector<std::vector<double>> JointChangeMotion::calc_way(const RobotModel& model) const {
  constexpr double kStep = 0.005;  // s
  constexpr double kTurn = 0.05;   // rad: an arm's end then moves 1 cm
  std::vector<std::vector<double>> way(1);
  sample(0, way.front());
  std::vector<double> position;
  for (double time = kStep; time < duration() + kStep; time += kStep) {
    sample(time, position);
    clip_to_limits(model, position);
    double largest = 0;
    for (size_t i = 0; i < position.size(); ++i) {
      largest = std::max(largest, std::abs(position[i] - way.back()[i]));
    }
    if (largest >= kTurn || time >= duration()) way.push_back(position);
  }
  return way;
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
  sample(time_, targets.position);
  return time_ < duration() ? Phase::kRunning : Phase::kDone;
}

double JointChangeMotion::progress() const {
  return duration() > 0 ? std::min(1.0, time_ / duration()) : 1.0;
}

void StopMotion::start(const MotionContext& context, const JointTargets& targets) {
  trajectory_ =
      JointTrajectory::stopping(targets.position, targets.velocity, stopping_rates(context));
  time_ = 0;
}

MotionGenerator::Phase StopMotion::step(const MotionContext& context, JointTargets& targets) {
  time_ += context.dt;
  trajectory_.sample(time_, targets.position);
  return time_ < trajectory_.duration() ? Phase::kRunning : Phase::kDone;
}

}  // namespace nao::motion
