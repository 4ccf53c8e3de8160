#include "daemons/motion/walk/kick_approach.h"

#include <cmath>
#include <limits>

namespace nao::motion {
namespace {

// Distance of the ball from its best place, m ahead and sideways, within which the step kicks.
// Chosen within the range by which the swing of the kick is adjusted (kMaxKickOffset in
// walk_kick.cpp).
constexpr double kToleranceAhead = 0.025;
constexpr double kToleranceAside = 0.02;
// Greatest number of steps of an approach: about eight seconds.
constexpr int kMaxSteps = 32;
// Cost of one more step, as a change of velocity, m/s. Without it, approaches to a ball at the side
// took ever more and ever slower steps: 29 of 30 kicks with it, 84 of 100 without (nao-trial
// walk-kick).
constexpr double kStepCost = 0.01;
// Greatest backward velocity of an approach, m/s. Chosen: half of the robot's limit.
constexpr double kMaxBackward = 0.1;

}  // namespace

KickApproach plan_kick_approach(const Eigen::Vector2d& offset, bool kicks_next,
                                const Eigen::Vector2d& commanded, double step_duration) {
  if (kicks_next && std::abs(offset.x()) <= kToleranceAhead &&
      std::abs(offset.y()) <= kToleranceAside) {
    return {};
  }
  KickApproach best;
  double least_cost = std::numeric_limits<double>::infinity();
  // Feet alternate: only every second number of steps ends with the kicking foot swinging.
  for (int n = kicks_next ? 2 : 1; n <= kMaxSteps; n += 2) {
    // Constant velocity, m/s in the body frame, with which the ball is at its best place after n
    // steps.
    const Eigen::Vector2d velocity = offset / (n * step_duration);
    const bool has_longer = n + 2 <= kMaxSteps;
    // Backwards the robot walks more slowly and takes more steps, unless none are left.
    if (velocity.x() < -kMaxBackward && has_longer) continue;
    // L1 distance to the operator's command plus the cost of steps, so that the approach that
    // changes the walk least wins.
    const double cost =
        std::abs(velocity.x() - commanded.x()) + std::abs(velocity.y()) + n * kStepCost;
    if (cost >= least_cost) continue;
    least_cost = cost;
    best = {n, velocity};
  }
  return best;
}

}  // namespace nao::motion
