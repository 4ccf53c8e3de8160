#include "daemons/motion/generators/joint_trajectory.h"

#include <algorithm>
#include <cmath>

#include "common/smooth_step.h"

namespace nao::motion {
namespace {

// Samples at which a path that starts with a velocity is checked against the rates. Chosen: between
// two of them velocity and acceleration exceed the rates by 5 % at most (measured by the test of
// this class).
constexpr int kNumSamples = 24;
// Factor by which such a path is extended until it keeps the rates, and the greatest number of
// times. Chosen: the duration is at most 15 % above the least one; 60 times make it 4000 times as
// long.
constexpr double kLengthening = 1.15;
constexpr int kMaxLengthenings = 60;

using Start = JointTrajectory::Start;

/** Greatest values of |b'| and |b''| over s in [0, 1]: 15/8 and 10/sqrt(3) for the smooth start,
 * 16/9 (at s = 1/3) and 12 (at s = 0) for the brisk one. */
double peak_velocity(Start how) {
  return how == Start::kBrisk ? 16.0 / 9 : 1.875;
}
double peak_acceleration(Start how) {
  return how == Start::kBrisk ? 12 : 10 / std::sqrt(3);
}

// Smooth start: the quintic 10 s^3 - 15 s^4 + 6 s^5 of smooth_step(). Brisk start: the quartic 6
// s^2 - 8 s^3 + 3 s^4, whose acceleration is largest at once and which still ends without one.
/** b and its first and second derivative by s. */
double blend(Start how, double s) {
  if (how == Start::kBrisk) return s * s * (6 + s * (-8 + s * 3));
  return smooth_step(s);
}
double blend_rate(Start how, double s) {
  if (how == Start::kBrisk) return 12 * s * (1 - s) * (1 - s);
  return s * s * (30 + s * (-60 + s * 30));
}
double blend_acceleration(Start how, double s) {
  if (how == Start::kBrisk) return 12 * (1 - s) * (1 - 3 * s);
  return s * (60 + s * (-180 + s * 120));
}

// c carries the initial velocity: c(0) = 0, c'(0) = 1, c''(0) = 0, and c = c' = c'' = 0 at s = 1.
// Path: q(s) = start + (goal - start) b(s) + v0 T c(s).
/** c and its first and second derivative by s. */
double coast(double s) {
  return s * (1 + s * s * (-6 + s * (8 - s * 3)));
}
double coast_rate(double s) {
  return 1 + s * s * (-18 + s * (32 - s * 15));
}
double coast_acceleration(double s) {
  return s * (-36 + s * (96 - s * 60));
}

}  // namespace

JointTrajectory::JointTrajectory(const std::vector<double>& start,
                                 const std::vector<double>& start_velocity,
                                 const std::vector<double>& goal,
                                 const std::vector<JointRates>& rates, double shortest, Start how)
    : how_(how), duration_(shortest), start_(start), start_velocity_(start_velocity), goal_(goal) {
  // From rest the least duration follows from the peaks of b' and b''.
  bool starts_at_rest = true;
  for (size_t i = 0; i < start_.size(); ++i) {
    // With distance D and duration T the peaks are D max|b'| / T and D max|b''| / T^2.
    const double distance = std::abs(goal_[i] - start_[i]);
    duration_ = std::max(duration_, peak_velocity(how) * distance / rates[i].max_velocity);
    duration_ = std::max(duration_,
                         std::sqrt(peak_acceleration(how) * distance / rates[i].max_acceleration));
    if (start_velocity_[i] != 0) {
      starts_at_rest = false;
      // Braking the initial velocity takes a least time.
      duration_ = std::max(duration_, std::abs(start_velocity_[i]) / rates[i].max_acceleration);
    }
  }
  // With an initial velocity there is no closed form: the path is made longer until it fits.
  for (int i = 0; !starts_at_rest && i < kMaxLengthenings && !keeps(rates); ++i) {
    duration_ *= kLengthening;
  }
}

JointTrajectory JointTrajectory::stopping(const std::vector<double>& start,
                                          const std::vector<double>& start_velocity,
                                          const std::vector<JointRates>& rates) {
  // With D = v0 T / 2 the velocity is v0 (1 - s)^2 (1 + 2 s): it falls monotonically to 0, and its
  // steepest slope is 1.5 v0 / T, at s = 1/2. All joints stay on one line through joint space.
  double duration = 0;
  for (size_t i = 0; i < start.size(); ++i) {
    duration = std::max(duration, 1.5 * std::abs(start_velocity[i]) / rates[i].max_acceleration);
  }
  std::vector<double> goal = start;
  for (size_t i = 0; i < start.size(); ++i) goal[i] += start_velocity[i] * duration / 2;
  JointTrajectory result;
  result.duration_ = duration;
  result.start_ = start;
  result.start_velocity_ = start_velocity;
  result.goal_ = goal;
  return result;
}

bool JointTrajectory::keeps(const std::vector<JointRates>& rates) const {
  for (size_t i = 0; i < start_.size(); ++i) {
    const double distance = goal_[i] - start_[i];
    const double coasting = start_velocity_[i] * duration_;
    // A joint that is faster than its rate at the start (after a change of speed) cannot be slower
    // at once: it may have its initial velocity.
    const double max_velocity = std::max(rates[i].max_velocity, std::abs(start_velocity_[i]));
    for (int k = 0; k <= kNumSamples; ++k) {
      const double s = static_cast<double>(k) / kNumSamples;
      const double velocity =
          (distance * blend_rate(how_, s) + coasting * coast_rate(s)) / duration_;
      const double acceleration =
          (distance * blend_acceleration(how_, s) + coasting * coast_acceleration(s)) /
          (duration_ * duration_);
      if (std::abs(velocity) > max_velocity * (1 + 1e-9)) return false;
      if (std::abs(acceleration) > rates[i].max_acceleration * (1 + 1e-9)) return false;
    }
  }
  return true;
}

void JointTrajectory::sample(double time, std::vector<double>& position) const {
  position.resize(start_.size());
  const double s = duration_ > 0 ? std::clamp(time / duration_, 0.0, 1.0) : 1.0;
  for (size_t i = 0; i < start_.size(); ++i) {
    // At the end exactly the goal, without the rounding of the polynomials.
    position[i] = s == 1.0 ? goal_[i]
                           : start_[i] + (goal_[i] - start_[i]) * blend(how_, s) +
                                 start_velocity_[i] * duration_ * coast(s);
  }
}

}  // namespace nao::motion
