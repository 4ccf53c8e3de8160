#include "daemons/motion/generators/joint_change_motion.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "daemons/motion/guards/joint_limits.h"
#include "daemons/motion/standing_rates.h"

namespace nao::motion {
namespace {

// Difference between commanded and clipped angle below which it is rounding, rad.
constexpr double kClippingTolerance = 1e-6;
// Time in which the stiffness changes, s. Chosen: a raised arm sinks instead of dropping, and one
// that becomes stiff does not jerk.
constexpr double kStiffnessTime = 0.5;

/** Angles that a change commands, before any limit. */
std::vector<double> commanded_angles(const RobotModel& model, const JointChangeCommand& change,
                                     const std::vector<double>& targets) {
  std::vector<double> commanded = targets;
  for (size_t i = 0; i < change.joint_names.size(); ++i) {
    const int motor = model.find_motor(change.joint_names[i]);
    commanded[motor] = change.joint_position[i] + (change.is_relative ? targets[motor] : 0.0);
  }
  return commanded;
}

/** Adds the ramps of motors that have none yet. */
void add_missing(const std::vector<MotionGenerator::StiffnessRamp>& more,
                 std::vector<MotionGenerator::StiffnessRamp>& ramps) {
  for (const auto& ramp : more) {
    const bool is_known = std::any_of(ramps.begin(), ramps.end(),
                                      [&](const auto& known) { return known.motor == ramp.motor; });
    if (!is_known) ramps.push_back(ramp);
  }
}

}  // namespace

std::vector<double> JointChangeMotion::calc_goal(const RobotModel& model,
                                                 const JointChangeCommand& change,
                                                 const std::vector<double>& targets) {
  std::vector<double> goal = commanded_angles(model, change, targets);
  clip_to_limits(model, goal);
  return goal;
}

void JointChangeMotion::start(const MotionContext& context, const JointTargets& targets) {
  std::vector<JointRates> rates =
      change_.allow_tipping
          ? joint_rates(context.model, change_.speed, context.options.max_acceleration)
          : standing_rates(context, change_.speed);
  // Starts briskly only if no named joint moves the body, and then raises the rates of those
  // joints.
  const JointTrajectory::Start how = choose_start(context, rates);
  // The joints that are not named stop; the named ones start from their present targets.
  stop_ = JointTrajectory::stopping(targets.position, targets.velocity, stopping_rates(context));
  // The goal starts from where the stopping joints come to rest, so that a relative change of a
  // joint that still moves counts from its present target.
  std::vector<double> base = stop_.goal();
  for (const std::string& name : change_.joint_names) {
    const int motor = context.model.find_motor(name);
    base[motor] = targets.position[motor];
  }
  const std::vector<double> goal = calc_goal(context.model, change_, base);
  note_clipping(context.model, commanded_angles(context.model, change_, base), goal);
  // Joints that rest have equal start and goal, and do not make the trajectory longer.
  std::vector<double> start = goal;
  std::vector<double> velocity(goal.size(), 0.0);
  turning_.clear();
  for (int motor = 0; motor < context.model.num_motors(); ++motor) {
    const std::string& name = context.model.motor_joint(motor).name;
    const auto& names = change_.joint_names;
    const bool is_named = std::find(names.begin(), names.end(), name) != names.end();
    // A joint that is not named and does not move is left to other writers.
    if (!is_named && goal[motor] == base[motor]) continue;
    turning_.push_back(motor);
    start[motor] = targets.position[motor];
    velocity[motor] = targets.velocity[motor];
  }
  trajectory_ = JointTrajectory(start, velocity, goal, rates, 0, how);
  stiffness_.clear();
  for (const StiffnessRamp& ramp : all_ramps(context.model)) {
    stiffness_.push_back({ramp.motor, targets.stiffness[ramp.motor], ramp.goal, ramp.time_left});
  }
  is_started_ = true;
  time_ = 0;
}

std::vector<MotionGenerator::StiffnessRamp> JointChangeMotion::own_ramps(
    const RobotModel& model) const {
  std::vector<StiffnessRamp> ramps;
  for (size_t i = 0; i < change_.joint_stiffness.size(); ++i) {
    if (std::isnan(change_.joint_stiffness[i])) continue;
    ramps.push_back(
        {model.find_motor(change_.joint_names[i]), change_.joint_stiffness[i], kStiffnessTime});
  }
  return ramps;
}

std::vector<MotionGenerator::StiffnessRamp> JointChangeMotion::all_ramps(
    const RobotModel& model) const {
  std::vector<StiffnessRamp> ramps = own_ramps(model);
  add_missing(continued_, ramps);
  return ramps;
}

void JointChangeMotion::continue_ramps(const std::vector<StiffnessRamp>& ramps) {
  add_missing(ramps, continued_);
}

std::vector<MotionGenerator::StiffnessRamp> JointChangeMotion::unfinished_ramps(
    const RobotModel& model) const {
  if (!is_started_) return all_ramps(model);
  std::vector<StiffnessRamp> ramps;
  for (const RunningRamp& ramp : stiffness_) {
    if (time_ >= ramp.duration) continue;
    ramps.push_back({ramp.motor, ramp.to, ramp.duration - time_});
  }
  return ramps;
}

double JointChangeMotion::duration() const {
  double duration = std::max(stop_.duration(), trajectory_.duration());
  for (const RunningRamp& ramp : stiffness_) {
    if (ramp.from != ramp.to) duration = std::max(duration, ramp.duration);
  }
  return duration;
}

void JointChangeMotion::note_clipping(const RobotModel& model, const std::vector<double>& commanded,
                                      const std::vector<double>& goal) {
  std::string clipped;
  for (const std::string& name : change_.joint_names) {
    const int motor = model.find_motor(name);
    if (std::abs(goal[motor] - commanded[motor]) < kClippingTolerance) continue;
    clipped += (clipped.empty() ? "" : ", ") + name;
  }
  if (!clipped.empty()) reason_ = Reason("clipped-to-limits", {clipped});
}

void JointChangeMotion::sample(double time, std::vector<double>& position) const {
  stop_.sample(time, position);
  std::vector<double> turning;
  trajectory_.sample(time, turning);
  for (int motor : turning_) position[motor] = turning[motor];
}

// The path of the motion in joint space, for the guards: sampled finely in time, and thinned out so
// that no joint turns by more than about kAngleStep between two entries.
std::vector<std::vector<double>> JointChangeMotion::calc_path(const RobotModel& model) const {
  constexpr double kTimeStep = 0.005;  // s
  // Chosen: the end of an arm, 0.2 m from its shoulder, then moves by 1 cm.
  constexpr double kAngleStep = 0.05;  // rad
  std::vector<std::vector<double>> path(1);
  sample(0, path.front());
  std::vector<double> position;
  for (double time = kTimeStep; time < duration() + kTimeStep; time += kTimeStep) {
    sample(time, position);
    clip_to_limits(model, position);
    double largest = 0;
    for (size_t i = 0; i < position.size(); ++i) {
      largest = std::max(largest, std::abs(position[i] - path.back()[i]));
    }
    if (largest >= kAngleStep || time >= duration()) path.push_back(position);
  }
  return path;
}

JointTrajectory::Start JointChangeMotion::choose_start(const MotionContext& context,
                                                       std::vector<JointRates>& rates) const {
  // A joint between a sole and the torso moves the whole body when it turns.
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
  for (const RunningRamp& ramp : stiffness_) {
    const double fraction = std::min(1.0, time_ / ramp.duration);
    // Exact at the end: a limp joint has the stiffness 0.
    targets.stiffness[ramp.motor] =
        fraction < 1 ? ramp.from + fraction * (ramp.to - ramp.from) : ramp.to;
  }
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
