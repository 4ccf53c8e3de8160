#pragma once

#include <vector>

namespace nao::motion {

/** Limits of a joint's target. */
struct JointRates {
  /** rad/s, rad/s^2. */
  double max_velocity = 0;
  double max_acceleration = 0;
};

/** Smooth path of all joints from moving targets to targets at rest: one polynomial of at most
 * fifth degree per joint, continuous in position and velocity at its start. All joints arrive
 * together.
 *
 * With the duration T, s = t / T, the distance D = goal - start and the initial velocity v0:
 *
 *     q(s) = q0 + D b(s) + v0 T c(s)
 *     smooth:  b = 10 s^3 - 15 s^4 + 6 s^5         b'' = 0 at both ends (minimum jerk)
 *     brisk:   b = 6 s^2 - 8 s^3 + 3 s^4           b''(0) = 12, the greatest value; b''(1) = 0
 *     coast:   c = s - 6 s^3 + 8 s^4 - 3 s^5       c'(0) = 1, c = c' = c'' = 0 at the end
 *
 * T is the least duration with which velocity and acceleration stay within the rates. */
class JointTrajectory {
 public:
  /** Start of the acceleration: at 0, for joints that carry the body; or at its greatest value, so
   * that a joint responds in the first control step. */
  enum class Start { kSmooth, kBrisk };

  JointTrajectory() = default;

  /** Plans the path.
   *
   * @param start     Targets, rad, and their velocities, rad/s. All lists have the same length.
   * @param goal      rad; where the targets come to rest.
   * @param rates     Limits of each joint. A joint that is faster at the start slows down.
   * @param shortest  Least duration, s.
   * @param how       Start of all joints, so that they stay on one line through joint space. */
  JointTrajectory(const std::vector<double>& start, const std::vector<double>& start_velocity,
                  const std::vector<double>& goal, const std::vector<JointRates>& rates,
                  double shortest = 0, Start how = Start::kSmooth);

  /** Plans to come to rest as soon as the accelerations allow, in the direction of the velocities.
   */
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
  /** Whether all samples of the path are within the rates. */
  bool keeps(const std::vector<JointRates>& rates) const;

  Start how_ = Start::kSmooth;
  double duration_ = 0;
  std::vector<double> start_;
  std::vector<double> start_velocity_;
  std::vector<double> goal_;
};

}  // namespace nao::motion
