#include "common/linear_solver.h"

#include <Eigen/Cholesky>

namespace nao {

void solve_positive_definite(Eigen::Ref<Eigen::MatrixXd> matrix,
                             Eigen::Ref<Eigen::VectorXd> vector) {  // NOLINT: it is written to
  const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> decomposition(matrix);
  vector = decomposition.solve(vector);
}

}  // namespace nao
