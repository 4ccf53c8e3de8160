#include "daemons/motion/walk/pendulum.h"

#include <gtest/gtest.h>

#include <cmath>

#include "daemons/motion/walk/pendulum_estimator.h"

namespace nao::motion {
namespace {

constexpr double kPendulumOmega = 6.1;

TEST(Pendulum, FollowsItsEquationOfMotion) {
  const Eigen::Vector2d zmp(0.01, -0.02);
  PendulumState fine{{0.03, 0.01}, {-0.1, 0.2}};
  const PendulumState exact = advance(fine, zmp, kPendulumOmega, 0.3);
  // Midpoint rule in steps of 10 us: its own error is about 1e-9 m.
  const double h = 1e-5;
  for (int i = 0; i < 30000; ++i) {
    const Eigen::Vector2d midpoint = fine.position + h / 2 * fine.velocity;
    const Eigen::Vector2d acceleration = kPendulumOmega * kPendulumOmega * (midpoint - zmp);
    fine.position += h * fine.velocity + h * h / 2 * acceleration;
    fine.velocity += h * acceleration;
  }
  EXPECT_NEAR((fine.position - exact.position).norm(), 0, 1e-6);
  EXPECT_NEAR((fine.velocity - exact.velocity).norm(), 0, 1e-5);
}

TEST(Pendulum, ItsDcmGrowsExponentiallyFromTheZmp) {
  const Eigen::Vector2d zmp(0.01, -0.02);
  const PendulumState start{{0.03, 0.01}, {-0.1, 0.2}};
  const PendulumState end = advance(start, zmp, kPendulumOmega, 0.3);
  const Eigen::Vector2d dcm = advance_dcm(start.dcm(kPendulumOmega), zmp, kPendulumOmega, 0.3);
  EXPECT_NEAR((end.dcm(kPendulumOmega) - dcm).norm(), 0, 1e-12);
  EXPECT_NEAR((advance_dcm(dcm, zmp, kPendulumOmega, -0.3) - start.dcm(kPendulumOmega)).norm(), 0,
              1e-12);
}

TEST(Pendulum, RestsOverAZmpThatIsHeldAtTheCapturePoint) {
  PendulumState state{{0.03, 0.01}, {-0.1, 0.2}};
  const Eigen::Vector2d capture_point = state.dcm(kPendulumOmega);
  state = advance(state, capture_point, kPendulumOmega, 2);
  EXPECT_NEAR((state.position - capture_point).norm(), 0, 1e-6);
  EXPECT_NEAR(state.velocity.norm(), 0, 1e-5);
}

TEST(Pendulum, TheZmpBetweenTwoDcmsLeadsFromOneToTheOther) {
  PendulumState state{{0.03, 0.01}, {-0.1, 0.2}};
  const Eigen::Vector2d goal(0.05, -0.07);
  const Eigen::Vector2d zmp =
      zmp_between_dcms(state.dcm(kPendulumOmega), goal, kPendulumOmega, 0.17);
  state = advance(state, zmp, kPendulumOmega, 0.17);
  EXPECT_NEAR((state.dcm(kPendulumOmega) - goal).norm(), 0, 1e-12);
}

TEST(PendulumEstimator, EstimatesTheVelocityFromNoisyPositions) {
  const Eigen::Vector2d zmp(0.01, 0);
  PendulumState truth{{0, 0.04}, {0.2, -0.25}};
  PendulumEstimator estimator(0.03, 1);
  estimator.reset(truth.position, truth.position);
  for (int tick = 0; tick < 20; ++tick) {
    truth = advance(truth, zmp, kPendulumOmega, 0.01);
    // Noise of half a millimeter with alternating sign.
    const Eigen::Vector2d noise = Eigen::Vector2d::Constant(tick % 2 == 0 ? 5e-4 : -5e-4);
    estimator.update(truth.position + noise, zmp, kPendulumOmega, 0.01);
  }
  EXPECT_NEAR((estimator.state().position - truth.position).norm(), 0, 1.5e-3);
  EXPECT_NEAR((estimator.state().velocity - truth.velocity).norm(), 0, 0.05);
}

TEST(PendulumEstimator, KeepsTheVelocityWhenTheSupportFootChanges) {
  PendulumEstimator estimator(0.03, 1);
  estimator.reset({0, 0}, {0, 0});
  for (int tick = 1; tick <= 100; ++tick) {
    estimator.update({0.002 * tick, 0}, {0.002 * tick, 0}, kPendulumOmega, 0.01);
  }
  EXPECT_NEAR(estimator.state().velocity.x(), 0.2, 0.01);
  // The new frame is turned to the left by 90 degrees.
  estimator.change_frame({0.01, 0.02}, M_PI / 2);
  EXPECT_EQ(estimator.state().position, Eigen::Vector2d(0.01, 0.02));
  EXPECT_NEAR(estimator.state().velocity.y(), -0.2, 0.01);
}

TEST(PendulumEstimator, LearnsTheOffsetOfTheMeasurementFromTheMotion) {
  // A tilted inertial unit shifts the position; the pressure balances a body that sways.
  const Eigen::Vector2d offset(0.008, -0.01);
  PendulumState truth{{0.01, 0.02}, {0, 0}};
  PendulumEstimator estimator(0.03, 1);
  estimator.reset(truth.position + offset, truth.position);
  for (int tick = 0; tick < 200; ++tick) {
    const Eigen::Vector2d sway(0.01 * std::sin(0.2 * tick), 0.02 * std::sin(0.25 * tick));
    const Eigen::Vector2d zmp = 2 * truth.dcm(kPendulumOmega) - sway;
    truth = advance(truth, zmp, kPendulumOmega, 0.01);
    estimator.update(truth.position + offset, zmp, kPendulumOmega, 0.01);
  }
  EXPECT_NEAR((estimator.offset() - offset).norm(), 0, 1e-3);
  EXPECT_NEAR((estimator.state().position - offset - truth.position).norm(), 0, 5e-4);
  EXPECT_NEAR((estimator.state().velocity - truth.velocity).norm(), 0, 1e-2);
}

// A robot whose center of pressure is noisy learns slowly, or keeps what it measured at rest.
TEST(PendulumEstimator, LearnsTheOffsetAsFastAsItsGainSays) {
  const auto learnt = [](double gain) {
    PendulumState truth{{0.01, 0}, {0, 0}};
    PendulumEstimator estimator(0.03, gain);
    estimator.reset(truth.position, truth.position);
    for (int tick = 0; tick < 30; ++tick) {
      truth = advance(truth, 2 * truth.dcm(kPendulumOmega), kPendulumOmega, 0.01);
      estimator.update(truth.position + Eigen::Vector2d(0.01, 0), 2 * truth.dcm(kPendulumOmega),
                       kPendulumOmega, 0.01);
    }
    return estimator.offset().x();
  };
  EXPECT_EQ(learnt(0), 0);
  EXPECT_LT(learnt(0.1), 0.5 * learnt(1));
  EXPECT_GT(learnt(1), 0);
}

TEST(PendulumEstimator, BoundsTheOffset) {
  PendulumEstimator estimator(0.03, 1);
  estimator.reset({0.5, -0.5}, {0, 0});
  EXPECT_LE(estimator.offset().cwiseAbs().maxCoeff(), 0.03 + 1e-12);
}

}  // namespace
}  // namespace nao::motion
