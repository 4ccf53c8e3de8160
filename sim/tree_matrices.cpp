// The linear algebra of TreeDynamics: its mass matrix, the factor, and the factor's inverse.

#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/tree_dynamics.h"

namespace nao::sim {

// The lower triangle serves for both halves: entry (i, j) adds to row i and, by symmetry, to row j.
void TreeDynamics::multiply_by_mass(const Eigen::VectorXd& factor, Eigen::VectorXd& product) const {
  const double* x = factor.data();
  double* result = product.data();
  std::fill(result, result + num_dofs_, 0.0);
  for (int i = 0; i < num_dofs_; ++i) {
    const double* row = row_of(mass_, i);
    const double value = x[i];
    double sum = 0;
    for (const int j : tree_.dof_ancestors(i)) {
      sum += *row * x[j];
      result[j] += *row * value;
      ++row;
    }
    result[i] += sum + *row * value;
  }
}

void TreeDynamics::factorize(const Eigen::VectorXd& diagonal) {
  std::copy(mass_.begin(), mass_.end(), factor_.begin());
  kernels_.factorize(matrix_rows_.data(), num_dofs_, diagonal.data(), factor_.data()->data(),
                     inverse_.data()->data());
}

// L^-T x: a sum of the rows of L^-1.
void TreeDynamics::solve_upper(Eigen::VectorXd& vector) const {
  double* x = vector.data();
  // The row of a dof adds to its ancestors, whose own factors are needed unchanged: the first one
  // is used last.
  for (int dof = 0; dof < num_dofs_; ++dof) {
    const double* row = row_of(inverse_, dof);
    const double value = x[dof];
    for (const int above : tree_.dof_ancestors(dof)) x[above] += *row++ * value;
    x[dof] = *row * value;
  }
}

// L^-1 x, from the last dof to the first: the ancestors' values are needed unchanged.
void TreeDynamics::solve_lower(Eigen::VectorXd& vector) const {
  double* x = vector.data();
  for (int dof = num_dofs_ - 1; dof >= 0; --dof) {
    const double* row = row_of(inverse_, dof);
    double sum = 0;
    for (const int above : tree_.dof_ancestors(dof)) sum += *row++ * x[above];
    x[dof] = sum + *row * x[dof];
  }
}

void TreeDynamics::calc_body_rows(int body, EntryPair* rows) const {
  const int count = num_pairs(static_cast<int>(tree_.bodies()[body].chain.size()));
  kernels_.calc_body_rows(constants_.data(), bodies_.data(), matrix_rows_.data(),
                          inverse_.data()->data(), is_root_fixed_, body, 2 * count, rows->data());
}

double TreeDynamics::mass_matrix(int row, int column) const {
  if (row < column) std::swap(row, column);
  const std::vector<int>& above = tree_.dof_ancestors(row);
  const auto place = std::lower_bound(above.begin(), above.end(), column) - above.begin();
  const bool is_in_pattern =
      row == column || (place < static_cast<long>(above.size()) && above[place] == column);
  return is_in_pattern ? row_of(mass_, row)[place] : 0;
}

}  // namespace nao::sim
