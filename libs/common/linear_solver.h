#pragma once

#include <Eigen/Core>

namespace nao {

/**
 * Solves A x = b by Cholesky decomposition, without allocation. Compiled once, for Eigen's
 * decompositions take a second of compiler time in each source that uses one.
 * @param matrix A, n x n, symmetric and positive definite; only its lower triangle is read.
 * Overwritten.
 * @param vector b of length n, overwritten by x. If A is not positive definite, it holds no
 * solution.
 */
void solve_positive_definite(Eigen::Ref<Eigen::MatrixXd> matrix,
                             Eigen::Ref<Eigen::VectorXd> vector);

}  // namespace nao
