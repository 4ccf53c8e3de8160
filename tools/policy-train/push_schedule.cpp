#include "tools/policy-train/push_schedule.h"

#include <algorithm>
#include <cmath>

namespace nao::policy_train {
namespace {

// Impulse of a batch's first pushes, N s for each kg. Chosen: half of what a walk without push
// recovery withstands ahead.
constexpr double kFirst = 0.3;
// Impulses of the pushes, as fractions of what is withstood half of the time, and the least of them
// that tells something of that. Chosen.
constexpr double kLeastFraction = 0.6;
constexpr double kMostFraction = 1.15;
constexpr double kTelling = 0.9;
// Factor on a cell's impulse after a push that was withstood, and divisor after a fall. Chosen:
// follows a policy that learns within some 50 pushes of a cell.
constexpr double kChange = 1.02;
// Exponent by which directions in which less is withstood are pushed more often. Chosen.
constexpr double kPreference = 3;
// Time after which a push has thrown a robot over or not, and mean time from then until the next
// one, s. Chosen: falls take less than 1.5 s.
constexpr double kDecided = 1.5;
constexpr double kPause = 0.5;

}  // namespace

PushSchedule::PushSchedule(double greatest) : greatest_(greatest) {
  impulses_.fill(std::min(greatest, kFirst));
}

PushSchedule::Push PushSchedule::draw(std::optional<double> phase, Random& random) const {
  const bool is_right = random.uniform() < 0.5;
  int column = kNumPhases;
  if (phase) {
    const double mirrored = *phase + (is_right ? 0.5 : 0);
    column = static_cast<int>((mirrored - std::floor(mirrored)) * kNumPhases) % kNumPhases;
  }
  std::array<double, kNumDirections> shares{};
  double sum = 0;
  for (int i = 0; i < kNumDirections; ++i) {
    const double impulse = impulses_[cell_of(i, column)];
    // Ahead and back are their own mirror images.
    const double share = i == 0 || i == kNumDirections - 1 ? 0.5 : 1;
    sum += share * std::pow(std::max(impulse, 1e-3), -kPreference);
    shares[i] = sum;
  }
  const auto chosen = std::upper_bound(shares.begin(), shares.end(), sum * random.uniform());
  const int direction = std::min(kNumDirections - 1, static_cast<int>(chosen - shares.begin()));
  Push push;
  push.cell = cell_of(direction, column);
  push.fraction = random.uniform(kLeastFraction, kMostFraction);
  // Anywhere nearer to this direction than to the others.
  const double between = M_PI / (kNumDirections - 1);
  const double angle = (direction + random.uniform(-0.5, 0.5)) * between * (is_right ? -1 : 1);
  const double impulse = std::min(greatest_, push.fraction * impulses_[push.cell]);
  push.impulse = impulse * Eigen::Vector2d(std::cos(angle), std::sin(angle));
  return push;
}

void PushSchedule::learn(const Push& push, bool fallen) {
  if (push.fraction < kTelling) return;
  double& impulse = impulses_[push.cell];
  impulse = std::min(greatest_, fallen ? impulse / kChange : impulse * kChange);
}

bool RobotPushes::is_due(double period, Random& random) const {
  return !last_ && random.uniform() < period / kPause;
}

Eigen::Vector2d RobotPushes::push(std::optional<double> phase, double time, Random& random) {
  last_ = schedule_->draw(phase, random);
  time_ = time;
  return last_->impulse;
}

void RobotPushes::judge(double time, bool fallen) {
  outcome_.reset();
  if (!last_ || (!fallen && time < time_ + kDecided)) return;
  outcome_ = {*last_, fallen};
  last_.reset();
}

}  // namespace nao::policy_train
