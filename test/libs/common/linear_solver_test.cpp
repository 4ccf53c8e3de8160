#include "common/linear_solver.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace nao {
namespace {

Eigen::MatrixXd random_positive_definite(int size, std::mt19937& generator) {
  std::normal_distribution<double> normal;
  const Eigen::MatrixXd root =
      Eigen::MatrixXd::NullaryExpr(size, size, [&] { return normal(generator); });
  return root * root.transpose() + 0.1 * Eigen::MatrixXd::Identity(size, size);
}

TEST(LinearSolver, SolutionSatisfiesTheEquations) {
  std::mt19937 generator(1);
  for (const int size : {1, 6, 12, 45}) {
    const Eigen::MatrixXd matrix = random_positive_definite(size, generator);
    const Eigen::VectorXd vector = Eigen::VectorXd::LinSpaced(size, -1, 2);
    Eigen::MatrixXd overwritten = matrix;
    Eigen::VectorXd solution = vector;
    solve_positive_definite(overwritten, solution);
    EXPECT_LT((matrix * solution - vector).norm(), 1e-9) << size;
  }
}

TEST(LinearSolver, ReadsOnlyTheLowerTriangleOfABlock) {
  std::mt19937 generator(2);
  const Eigen::MatrixXd matrix = random_positive_definite(8, generator);
  Eigen::MatrixXd overwritten = matrix;
  overwritten.triangularView<Eigen::StrictlyUpper>().setConstant(std::nan(""));
  Eigen::VectorXd vector = Eigen::VectorXd::Ones(8);
  solve_positive_definite(overwritten.bottomRightCorner(5, 5), vector.tail(5));
  EXPECT_LT((matrix.bottomRightCorner(5, 5) * vector.tail(5) - Eigen::VectorXd::Ones(5)).norm(),
            1e-9);
  EXPECT_EQ(vector.head(3), Eigen::VectorXd::Ones(3));
}

}  // namespace
}  // namespace nao
