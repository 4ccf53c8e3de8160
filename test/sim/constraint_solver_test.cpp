#include "sim/constraint_solver.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace nao::sim {
namespace {

constexpr int kNumPairs = 3;
constexpr int kNumDofs = 2 * kNumPairs;
constexpr double kTolerance = 1e-5;

/** A foot's plate, 10 cm long and 6 cm wide, on the floor. It turns with its own small inertia and
 * moves with the mass that the leg bears; dofs: moves along z, x, y, turns about x, y, z. */
class PlateTest : public testing::Test {
 protected:
  static constexpr double kMass = 5;         // kg
  static constexpr double kInertia = 5e-4;   // kg m^2
  static constexpr double kSoftness = 0.05;  // m/s per N s

  PlateTest() {
    solver_.reserve(8, 1, 1, kNumDofs, 100);
    const std::array<int, kNumDofs> dofs{0, 1, 2, 3, 4, 5};
    chain_ = solver_.add_chain(dofs.data(), kNumDofs, 0);
    z_.setZero(kNumDofs);
  }

  void add_corners(double friction) {
    for (const double x : {0.05, -0.05}) {
      for (const double y : {0.03, -0.03}) add_contact(x, y, friction);
    }
  }

  void add_contact(double x, double y, double friction) {
    Eigen::Map<Eigen::Matrix<double, 3, kNumDofs, Eigen::RowMajor>> rows(
        solver_.add_entries(3 * kNumPairs)->data());
    rows << 1, 0, 0, y, -x, 0,  //
        0, 1, 0, 0, 0, -y,      //
        0, 0, 1, 0, 0, x;
    rows.leftCols<3>() /= std::sqrt(kMass);
    rows.rightCols<3>() /= std::sqrt(kInertia);
    ContactBlock& block = *solver_.begin_block();
    block.chain = chain_;
    block.entries = reinterpret_cast<const EntryPair*>(rows.data());
    block.friction = friction;
    block.normal_softness = block.tangent_softness = kSoftness;
    solver_.end_block();
  }

  int solve(int max_iterations = 50) { return solver_.solve(z_, {max_iterations, kTolerance}); }

  /** The velocity of one row and the softness' part, m/s: 0 where it presses or sticks. */
  double error(const ContactBlock& block, int row) const {
    double sum = kSoftness * block.impulse[row];
    for (int i = 0; i < kNumDofs; ++i) {
      sum += block.entries[row * kNumPairs + i / 2][i % 2] * z_[i];
    }
    return sum;
  }

  ConstraintSolver solver_;
  int chain_ = -1;
  Eigen::VectorXd z_;
};

TEST_F(PlateTest, CornersThatBearMuchMoreThanThePlateConvergeInFewIterations) {
  add_corners(0.5);
  z_ << -0.02 * std::sqrt(kMass), 0.001 * std::sqrt(kMass), 0, 0, 0, 0;
  EXPECT_LE(solve(), 10);
  for (const ContactBlock& block : solver_.blocks()) {
    for (int row = 0; row < 3; ++row) EXPECT_NEAR(error(block, row), 0, 2 * kTolerance);
    // The impulse that stops a quarter of the mass, with the corner's share of the softness.
    EXPECT_NEAR(block.impulse[0], 0.02 / (4 / kMass + kSoftness), 1e-3);
  }
}

TEST_F(PlateTest, CornersThatRiseDoNotPull) {
  add_corners(0.5);
  // The plate tips about its front edge.
  z_ << 0.02 * std::sqrt(kMass), 0, 0, 0, 2 * std::sqrt(kInertia), 0;
  EXPECT_LT(solve(), 50);
  int num_open = 0;
  for (const ContactBlock& block : solver_.blocks()) {
    EXPECT_GE(block.impulse[0], 0);
    if (block.impulse[0] > 0) {
      EXPECT_NEAR(error(block, 0), 0, 2 * kTolerance);
    } else {
      EXPECT_GE(error(block, 0), -2 * kTolerance);
      ++num_open;
    }
  }
  EXPECT_EQ(num_open, 2);
}

TEST_F(PlateTest, WhatSlidesIsBrakedByItsFriction) {
  add_corners(0.1);
  z_ << -0.02 * std::sqrt(kMass), 0.5 * std::sqrt(kMass), 0, 0, 0, 0;
  EXPECT_LT(solve(), 50);
  for (const ContactBlock& block : solver_.blocks()) {
    EXPECT_NEAR(error(block, 0), 0, 2 * kTolerance);
    EXPECT_NEAR(block.impulse[1], -0.1 * block.impulse[0], 1e-9);
    EXPECT_NEAR(block.impulse[2], 0, 1e-6);
  }
}

TEST_F(PlateTest, VelocityAndImpulsesBelongTogether) {
  add_corners(0.3);
  const Eigen::VectorXd before = z_ = Eigen::VectorXd::LinSpaced(kNumDofs, -0.1, 0.05);
  solve(12);
  Eigen::VectorXd expected = before;
  for (const ContactBlock& block : solver_.blocks()) {
    for (int row = 0; row < 3; ++row) {
      for (int i = 0; i < kNumDofs; ++i) {
        expected[i] += block.entries[row * kNumPairs + i / 2][i % 2] * block.impulse[row];
      }
    }
  }
  EXPECT_TRUE(z_.isApprox(expected, 1e-9)) << z_.transpose() << "\n" << expected.transpose();
}

}  // namespace
}  // namespace nao::sim
