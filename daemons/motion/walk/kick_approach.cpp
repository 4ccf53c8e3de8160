#include "daemons/motion/walk/kick_approach.h"

#include <cmath>
#include <limits>

namespace nao::motion {
namespace {

// The ball is struck from here: what the swing makes up for, m ahead and aside.
constexpr double kReachAhead = 0.025;
constexpr double kReachAside = 0.02;
// An approach is planned over as many steps at most: eight seconds.
constexpr int kMostSteps = 32;
// What a step more costs, as a change of velocity, m/s: without it the robot would come nearer and
// nearer to a ball aside of it, and slower and slower, and never kick.
constexpr double kStepCost = 0.01;
// Steps back on the way to a ball are as slow as this at most, m/s.
constexpr double kFastestBack = 0.1;

}  // namespace

KickApproach plan_kick_approach(const Eigen::Vector2d& way, bool kicks_next,
                                const Eigen::Vector2d& wished, double step_duration) {
  if (kicks_next && std::abs(way.x()) <= kReachAhead && std::abs(way.y()) <= kReachAside) return {};
  KickApproach best;
  double least = std::numeric_limits<double>::infinity();
  for (int n = kicks_next ? 2 : 1; n <= kMostSteps; n += 2) {
    Eigen::Vector2d velocity = way / (n * step_duration);
    if (velocity.x() < -kFastestBack && n + 2 <= kMostSteps) continue;
    const double cost =
        std::abs(velocity.x() - wished.x()) + std::abs(velocity.y()) + n * kStepCost;
    if (cost >= least) continue;
    least = cost;
    best = {n, velocity};
  }
  return best;
}

}  // namespace nao::motion
