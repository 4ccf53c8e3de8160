#include "daemons/motion/walk/pendulum.h"

#include <gtest/gtest.h>

#include "daemons/motion/walk/pendulum_estimator.h"

namespace nao::motion {
namespace {

constexpr double kOmega = 6.1;

TEST(Pendulum, FollowsItsEquationOfMotion) {
  const Eigen::Vector2d zmp(0.01, -0.02);
  PendulumState fine{{0.03, 0.01}, {-0.1, 0.2}};
  const PendulumState exact = advance(fine, zmp, kOmega, 0.3);
  // Midpoint rule in steps of 10 us: its own error is about 1e-9 m.
  const double h = 1e-5;
  for (int i = 0; i < 30000; ++i) {
    const Eigen::Vector2d middle = fine.position + h / 2 * fine.velocity;
    const Eigen::Vector2d acceleration = kOmega * kOmega * (middle - zmp);
    fine.position += h * fine.velocity + h * h / 2 * acceleration;
    fine.velocity += h * acceleration;
  }
  EXPECT_NEAR((fine.position - exact.position).norm(), 0, 1e-6);
  EXPECT_NEAR((fine.velocity - exact.velocity).norm(), 0, 1e-5);
}

TEST(Pendulum, SteeringPointBringsTheDivergentComponentToItsGoal) {
  PendulumState state{{0.03, 0.01}, {-0.1, 0.2}};
  const Eigen::Vector2d goal(0.05, -0.07);
  const Eigen::Vector2d zmp = steering_point(state.divergent(kOmega), goal, kOmega, 0.17);
  state = advance(state, zmp, kOmega, 0.17);
  EXPECT_NEAR((state.divergent(kOmega) - goal).norm(), 0, 1e-12);
}

TEST(PendulumEstimator, FindsTheVelocityOfAMassThatItIsNotTold) {
  const Eigen::Vector2d zmp(0.01, 0);
  PendulumState truth{{0, 0.04}, {0.2, -0.25}};
  PendulumEstimator estimator;
  estimator.reset(truth.position);
  for (int tick = 0; tick < 20; ++tick) {
    truth = advance(truth, zmp, kOmega, 0.01);
    // Half a millimetre of noise, to and fro.
    const Eigen::Vector2d noise = Eigen::Vector2d::Constant(tick % 2 == 0 ? 5e-4 : -5e-4);
    estimator.update(truth.position + noise, zmp, kOmega, 0.01);
  }
  EXPECT_NEAR((estimator.state().position - truth.position).norm(), 0, 1.5e-3);
  EXPECT_NEAR((estimator.state().velocity - truth.velocity).norm(), 0, 0.05);
}

}  // namespace
}  // namespace nao::motion
