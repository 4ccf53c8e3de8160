#include "tools/tuning/cma_es.h"

#include <gtest/gtest.h>

namespace nao {
namespace {

/** Rosenbrock function: a curved, narrow valley; minimum 0 at (1, ..., 1). */
double rosenbrock(const Eigen::VectorXd& x) {
  double sum = 0;
  for (int i = 0; i + 1 < x.size(); ++i) {
    sum += 100 * std::pow(x[i + 1] - x[i] * x[i], 2) + std::pow(1 - x[i], 2);
  }
  return sum;
}

Eigen::VectorXd minimise(int generations, uint64_t seed) {
  CmaEs search(Eigen::VectorXd::Zero(6), 0.3, 12, seed);
  for (int i = 0; i < generations; ++i) {
    std::vector<double> costs;
    for (const Eigen::VectorXd& x : search.ask()) costs.push_back(rosenbrock(x));
    search.tell(costs);
  }
  return search.mean();
}

TEST(CmaEs, MinimizesTheRosenbrockFunction) {
  const Eigen::VectorXd x = minimise(400, 1);
  EXPECT_NEAR((x - Eigen::VectorXd::Ones(6)).norm(), 0, 1e-4);
}

TEST(CmaEs, DependsOnTheSeedOnly) {
  EXPECT_EQ(minimise(10, 7), minimise(10, 7));
  EXPECT_NE(minimise(10, 7), minimise(10, 8));
}

}  // namespace
}  // namespace nao
