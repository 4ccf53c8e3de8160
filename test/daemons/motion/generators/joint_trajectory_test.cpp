#include "daemons/motion/generators/joint_trajectory.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace nao::motion {
namespace {

TEST(JointTrajectory, KeepsItsLimitsFromAnyStart) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> angle(-2, 2);
  std::uniform_real_distribution<double> fraction(-1, 1);
  for (int trial = 0; trial < 1000; ++trial) {
    const auto how =
        trial % 2 == 0 ? JointTrajectory::Start::kSmooth : JointTrajectory::Start::kBrisk;
    const std::vector<JointRates> rates = {{3, 30}, {6, 30}, {1, 10}};
    std::vector<double> start;
    std::vector<double> velocity;
    std::vector<double> goal;
    for (const JointRates& rate : rates) {
      start.push_back(angle(random));
      goal.push_back(angle(random));
      velocity.push_back(trial % 3 == 0 ? 0 : fraction(random) * rate.max_velocity);
    }
    const JointTrajectory trajectory(start, velocity, goal, rates, 0, how);
    constexpr double kStep = 1e-3;
    std::vector<double> a;
    std::vector<double> b;
    std::vector<double> c;
    for (double t = kStep; t < trajectory.duration() - kStep; t += kStep) {
      trajectory.sample(t - kStep, a);
      trajectory.sample(t, b);
      trajectory.sample(t + kStep, c);
      for (size_t i = 0; i < rates.size(); ++i) {
        // The rates are checked at 24 samples of the path: between them they may be exceeded a
        // little.
        EXPECT_LE(std::abs(b[i] - a[i]) / kStep, rates[i].max_velocity * 1.02);
        EXPECT_LE(std::abs(a[i] - 2 * b[i] + c[i]) / (kStep * kStep),
                  rates[i].max_acceleration * 1.05);
      }
    }
    trajectory.sample(trajectory.duration(), a);
    EXPECT_EQ(a, goal);
    trajectory.sample(0, a);
    for (size_t i = 0; i < rates.size(); ++i) EXPECT_NEAR(a[i], start[i], 1e-12);
  }
}

TEST(JointTrajectory, StartsWithTheGivenVelocity) {
  const JointTrajectory trajectory({0.0}, {-2.0}, {1.0}, {{3, 30}});
  std::vector<double> position;
  trajectory.sample(1e-6, position);
  EXPECT_NEAR(position[0] / 1e-6, -2.0, 1e-3);
}

TEST(JointTrajectory, ABriskStartUsesTheGreatestAccelerationAtOnce) {
  const JointTrajectory trajectory({0.0}, {0.0}, {0.4}, {{7, 200}}, 0,
                                   JointTrajectory::Start::kBrisk);
  constexpr double kStep = 1e-4;
  const auto acceleration_at = [&](double time) {
    std::vector<double> a;
    std::vector<double> b;
    std::vector<double> c;
    trajectory.sample(time - kStep, a);
    trajectory.sample(time, b);
    trajectory.sample(time + kStep, c);
    return (a[0] - 2 * b[0] + c[0]) / (kStep * kStep);
  };
  EXPECT_NEAR(acceleration_at(kStep), 200, 2);
  EXPECT_NEAR(acceleration_at(trajectory.duration() - kStep), 0, 1);
}

TEST(JointTrajectory, StoppingNeverTurnsBack) {
  const JointTrajectory trajectory =
      JointTrajectory::stopping({0.0, 1.0}, {2.0, -0.5}, {{3, 30}, {3, 30}});
  EXPECT_NEAR(trajectory.duration(), 1.5 * 2.0 / 30, 1e-12);
  std::vector<double> last = {0.0, 1.0};
  std::vector<double> position;
  for (double t = 0; t <= trajectory.duration() + 0.01; t += 1e-3) {
    trajectory.sample(t, position);
    EXPECT_GE(position[0], last[0] - 1e-12);
    EXPECT_LE(position[1], last[1] + 1e-12);
    // Both joints stay on one line through joint space, so that a symmetric crouch stays one.
    EXPECT_NEAR(position[0] / 2.0, (position[1] - 1.0) / -0.5, 1e-12);
    last = position;
  }
}

TEST(JointTrajectory, TakesAtLeastTheShortestDuration) {
  EXPECT_DOUBLE_EQ(JointTrajectory({0.0}, {0.0}, {0.01}, {{3, 30}}, 2.0).duration(), 2.0);
}

}  // namespace
}  // namespace nao::motion
