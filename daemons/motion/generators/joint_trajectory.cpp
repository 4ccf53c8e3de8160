#include "daemons/motion/generators/joint_trajectory.h"

#include <algorithm>
#include <cmath>

namespace nao::motion {
namespace {

constexpr int kNumSamples = 24;
constexpr double kLengthening = 1.15;
constexpr int kMaxLengthenings = 60;

// With s = t / T the way is  q(s) = q0 + D b(s) + v0 T c(s),  D = goal - q0,
// b = 10 s^3 - 15 s^4 + 6 s^5,  c = s - 6 s^3 + 8 s^4 - 3 s^5:
// the Hermite basis of fifth degree with accelerations 0 at both ends. A brisk start has
// b = 6 s^2 - 8 s^3 + 3 s^4  in its place: greatest acceleration at once, a third of it at the end.
using Start = JointTrajectory::Start;

/** Peaks of the velocity and the acceleration of b over s in [0, 1]. */
double peak_velocity(Start how) {
  return how == Start::kBrisk ? 16.0 / 9 : 1.875;
}
double peak_acceleration(Start how) {
  return how == Start::kBrisk ? 12 : 10 / std::sqrt(3);
}

double blend(Start how, double s) {
  if (how == Start::kBrisk) return s * s * (6 + s * (-8 + s * 3));
  return s * s * s * (10 + s * (-15 + s * 6));
}
double blend_rate(Start how, double s) {
  if (how == Start::kBrisk) return 12 * s * (1 - s) * (1 - s);
  return s * s * (30 + s * (-60 + s * 30));
}
double blend_acceleration(Start how, double s) {
  if (how == Start::kBrisk) return 12 * (1 - s) * (1 - 3 * s);
  return s * (60 + s * (-180 + s * 120));
}
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
  bool starts_at_rest = true;
  for (size_t i = 0; i < start_.size(); ++i) {
    const double distance = std::abs(goal_[i] - start_[i]);
    duration_ = std::max(duration_, peak_velocity(how) * distance / rates[i].max_velocity);
    duration_ = std::max(duration_,
                         std::sqrt(peak_acceleration(how) * distance / rates[i].max_acceleration));
    if (start_velocity_[i] != 0) {
      starts_at_rest = false;
      duration_ = std::max(duration_, std::abs(start_velocity_[i]) / rates[i].max_acceleration);
    }
  }
  for (int i = 0; !starts_at_rest && i < kMaxLengthenings && !keeps(rates); ++i) {
    duration_ *= kLengthening;
  }
}

JointTrajectory JointTrajectory::stopping(const std::vector<double>& start,
                                          const std::vector<double>& start_velocity,
                                          const std::vector<JointRates>& rates) {
  // Going half as far as v T brings each joint straight to rest, and all of them along one line:
  // D = v T / 2 makes the velocity v (1 - s)^2 (1 + 2 s), with the steepest slope 1.5 v / T.
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
    position[i] = s == 1.0 ? goal_[i]
                           : start_[i] + (goal_[i] - start_[i]) * blend(how_, s) +
                                 start_velocity_[i] * duration_ * coast(s);
  }
}

}  // namespace nao::motion
