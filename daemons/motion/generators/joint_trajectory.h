#pragma once

#include <vector>

namespace nao::motion {

/** What a joint's targets may do. */
struct JointRates {
  /** rad/s, rad/s^2. */
  double max_velocity = 0;
  double max_acceleration = 0;
};

/** Smooth way of all joints from moving targets to resting ones: a polynomial of fifth degree for
 * each, so that position and velocity go on from where they are and acceleration ends at 0. */
class JointTrajectory {
 public:
  /** How the acceleration begins: at 0, as joints that carry the body need it, or with its greatest
   * value at once, so that a joint answers in the first tick. */
  enum class Start { kSmooth, kBrisk };

  JointTrajectory() = default;

  /** Plans the way on which all joints arrive together.
   *
   * @param start     Where the targets are, rad, and how fast they move, rad/s.
   * @param goal      rad; where they come to rest. All lists have the same length.
   * @param rates     Limits that the targets keep. One that moves faster at the start slows down.
   * @param shortest  The way takes at least this long, s.
   * @param how       All joints begin so: then they stay on one line through joint space. */
  JointTrajectory(const std::vector<double>& start, const std::vector<double>& start_velocity,
                  const std::vector<double>& goal, const std::vector<JointRates>& rates,
                  double shortest = 0, Start how = Start::kSmooth);

  /** Plans to come to rest as soon as the accelerations allow, along the present direction. */
  static JointTrajectory stopping(const std::vector<double>& start,
                                  const std::vector<double>& start_velocity,
                                  const std::vector<JointRates>& rates);

  /** s. */
  double duration() const { return duration_; }
  /** rad. */
  const std::vector<double>& goal() const { return goal_; }

  /** Targets at a time since the start, s; the goal from duration() on.
   * @param position  rad, set. */
  void sample(double time, std::vector<double>& position) const;

 private:
  bool keeps(const std::vector<JointRates>& rates) const;

  Start how_ = Start::kSmooth;
  double duration_ = 0;
  std::vector<double> start_;
  std::vector<double> start_velocity_;
  std::vector<double> goal_;
};

}  // namespace nao::motion
