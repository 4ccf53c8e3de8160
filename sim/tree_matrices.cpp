// The linear algebra of TreeDynamics: its mass matrix, the factor, and the factor's inverse.

#include <algorithm>
#include <array>
#include <utility>

#include "sim/tree_dynamics.h"

namespace nao::sim {

namespace {

/** Entries of a vector for the root's six dofs, which every joint's row begins with: in registers.
 */
struct RootEntries {
  EntryPair a;
  EntryPair b;
  EntryPair c;

  explicit RootEntries(const double* from)
      : a(from[0], from[1]), b(from[2], from[3]), c(from[4], from[5]) {}
  void add(const double* row, double factor) {
    a += EntryPair(row[0], row[1]) * factor;
    b += EntryPair(row[2], row[3]) * factor;
    c += EntryPair(row[4], row[5]) * factor;
  }
  void store(double* to) const {
    to[0] = a[0];
    to[1] = a[1];
    to[2] = b[0];
    to[3] = b[1];
    to[4] = c[0];
    to[5] = c[1];
  }
};

}  // namespace

// The lower triangle serves for both halves: entry (i, j) adds to row i and, by symmetry, to row j.
void TreeDynamics::multiply_by_mass(const Eigen::VectorXd& factor, Eigen::VectorXd& product) const {
  const double* x = factor.data();
  double* result = product.data();
  std::fill(result, result + num_dofs_, 0.0);
  for (int i = 0; i < 6; ++i) {
    const double* row = row_of(mass_, i);
    double sum = 0;
    for (int j = 0; j < i; ++j) {
      sum += row[j] * x[j];
      result[j] += row[j] * x[i];
    }
    result[i] += sum + row[i] * x[i];
  }
  RootEntries root(result);
  for (int i = 6; i < num_dofs_; ++i) {
    const double* row = row_of(mass_, i);
    const double value = x[i];
    root.add(row, value);
    double sum = 0;
    for (int j = 0; j < 6; ++j) sum += row[j] * x[j];
    const std::vector<int>& above = tree_.dof_ancestors(i);
    const int depth = static_cast<int>(above.size());
    for (int k = 6; k < depth; ++k) {
      sum += row[k] * x[above[k]];
      result[above[k]] += row[k] * value;
    }
    result[i] += sum + row[depth] * value;
  }
  root.store(result);
}

void TreeDynamics::factorize(const Eigen::VectorXd& diagonal) {
  std::copy(mass_.begin(), mass_.end(), factor_.begin());
  kernels_.factorize(matrix_rows_.data(), elimination_order_.data(), num_dofs_, diagonal.data(),
                     factor_.data()->data(), inverse_.data()->data(), inverse_squares_.data());
}

// L^-T x: a sum of the rows of L^-1.
void TreeDynamics::solve_upper(Eigen::VectorXd& vector) const {
  double* x = vector.data();
  // The row of a dof adds to its ancestors, whose own factors are needed unchanged: the first one
  // is used last.
  for (int dof = 0; dof < 6; ++dof) {
    const double* row = row_of(inverse_, dof);
    const double value = x[dof];
    for (int above = 0; above < dof; ++above) x[above] += row[above] * value;
    x[dof] = row[dof] * value;
  }
  RootEntries root(x);
  for (int dof = 6; dof < num_dofs_; ++dof) {
    const double* row = row_of(inverse_, dof);
    const double value = x[dof];
    root.add(row, value);
    const std::vector<int>& above = tree_.dof_ancestors(dof);
    const int depth = static_cast<int>(above.size());
    for (int k = 6; k < depth; ++k) x[above[k]] += row[k] * value;
    x[dof] = row[depth] * value;
  }
  root.store(x);
}

// L^-1 x, from the last dof to the first: the ancestors' values are needed unchanged.
void TreeDynamics::solve_lower(Eigen::VectorXd& vector) const {
  double* x = vector.data();
  for (int dof = num_dofs_ - 1; dof >= 0; --dof) {
    const double* row = row_of(inverse_, dof);
    const std::vector<int>& above = tree_.dof_ancestors(dof);
    const int depth = static_cast<int>(above.size());
    double sum = 0;
    // The first ancestors of all are the root's dofs.
    const int first = std::min(depth, 6);
    for (int k = 0; k < first; ++k) sum += row[k] * x[k];
    for (int k = first; k < depth; ++k) sum += row[k] * x[above[k]];
    x[dof] = sum + row[depth] * x[dof];
  }
}

// The root's rows of M u: the root's generalized momentum is that of the whole tree about O.
SpatialVector TreeDynamics::momentum_at(const Eigen::VectorXd& velocity) const {
  std::array<double, 6> sum{};
  const double* u = velocity.data();
  for (int i = 0; i < 6; ++i) {
    const double* row = row_of(mass_, i);
    for (int j = 0; j < i; ++j) {
      sum[i] += row[j] * u[j];
      sum[j] += row[j] * u[i];
    }
    sum[i] += row[i] * u[i];
  }
  RootEntries root(sum.data());
  for (int dof = 6; dof < num_dofs_; ++dof) root.add(row_of(mass_, dof), u[dof]);
  root.store(sum.data());
  return {{sum[0], sum[1], sum[2]}, {sum[3], sum[4], sum[5]}};
}

void TreeDynamics::calc_body_rows(int body, EntryPair* rows) const {
  const int count = num_pairs(static_cast<int>(tree_.bodies()[body].chain.size()));
  kernels_.calc_body_rows(constants_.data(), bodies_.data(), matrix_rows_.data(),
                          inverse_.data()->data(), is_root_fixed_, body, 2 * count, rows->data());
}

void TreeDynamics::copy_mass_matrix(Eigen::MatrixXd& mass) const {
  mass.setZero(num_dofs_, num_dofs_);
  for (int dof = 0; dof < num_dofs_; ++dof) {
    const double* row = row_of(mass_, dof);
    for (const int above : tree_.dof_ancestors(dof)) {
      mass(dof, above) = mass(above, dof) = *row++;
    }
    mass(dof, dof) = *row;
  }
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
