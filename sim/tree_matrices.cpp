// The linear algebra of TreeDynamics: its mass matrix, the factor, and the factor's inverse.

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "sim/constant_count.h"
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

namespace {

/** Numbers of ancestors of a NAO's and other humanoids' joints. */
template <class Work>
[[gnu::always_inline]] inline void with_constant_depth(int depth, Work work) {
  with_constant<6, 11>(depth, work);
}

}  // namespace

void TreeDynamics::factorize(const Eigen::VectorXd& diagonal) {
  // From the last dof to the first, each row changes those of its ancestors only, so that entries
  // outside the tree's pattern stay 0. The ancestors' rows are as long as their places in the row:
  // the entries of one are for the same dofs as the first ones of the other.
  std::copy(mass_.begin(), mass_.end(), factor_.begin());
  // L^T L of a tree (Featherstone, table 6.3): eliminates the leaves first, so that no fill-in
  // occurs. Row k of L is sqrt on the diagonal and M(k, j) / sqrt for its ancestors j.
  for (int k = num_dofs_ - 1; k >= 0; --k) {
    const std::vector<int>& ancestors = tree_.dof_ancestors(k);
    const int* above = ancestors.data();
    with_constant_depth(static_cast<int>(ancestors.size()), [&](auto depth) {
      double* row = row_of(factor_, k);
      const double root = std::sqrt(row[depth] + diagonal[k]);
      const double inverse = 1 / root;
      // 0 instead of the diagonal entry while the row is subtracted, pair by pair.
      row[depth] = 0;
      EntryPair* pairs = &factor_[static_cast<size_t>(k) * pairs_of_row_];
      for (int pair = 0; pair < num_pairs(depth); ++pair) pairs[pair] *= inverse;
      // Schur complement: subtracts the outer product of the row from the ancestors' block. What
      // this adds behind the diagonal of an ancestor's row is never read.
      for (int a = 0; a < depth; ++a) {
        EntryPair* target = &factor_[static_cast<size_t>(above[a]) * pairs_of_row_];
        const double factor = row[a];
        for (int pair = 0; pair <= a / 2; ++pair) target[pair] -= factor * pairs[pair];
      }
      row[depth] = root;
    });
  }
  invert_factor();
}

// L L^-1 = 1, row by row: L_dd (L^-1)_d = e_d - sum of L_da (L^-1)_a over the ancestors a of d,
// whose rows are beginnings of the row of d, as their ancestors are the first ones of d's.
void TreeDynamics::invert_factor() {
  for (int dof = 0; dof < num_dofs_; ++dof) {
    const std::vector<int>& ancestors = tree_.dof_ancestors(dof);
    const int* above = ancestors.data();
    with_constant_depth(static_cast<int>(ancestors.size()), [&](auto depth) {
      const double* factor = row_of(factor_, dof);
      const double inverse = 1 / factor[depth];
      EntryPair* row = &inverse_[static_cast<size_t>(dof) * pairs_of_row_];
      for (int pair = 0; pair < num_pairs(depth + 1); ++pair) row[pair] = EntryPair::Zero();
      for (int k = 0; k < depth; ++k) {
        const EntryPair* row_above = inverse_row(above[k]);
        const double weight = -inverse * factor[k];
        for (int pair = 0; pair <= k / 2; ++pair) row[pair] += weight * row_above[pair];
      }
      row_of(inverse_, dof)[depth] = inverse;
    });
  }
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

void TreeDynamics::calc_body_rows(int body_index, EntryPair* rows) const {
  const std::vector<int>& chain = tree_.bodies()[body_index].chain;
  const int count = num_pairs(static_cast<int>(chain.size()));
  const bool is_in_series = tree_.bodies()[body_index].is_in_series;
  // Pair by pair, so that the six sums stay in registers.
  for (int pair = 0; pair < count; ++pair) {
    std::array<EntryPair, 6> sum;
    // The root's J is the unit matrix.
    for (int axis = 0; axis < 6; ++axis) {
      const bool has_entry = !is_root_fixed_ && 2 * pair <= axis;
      sum[axis] = has_entry ? inverse_row(axis)[pair] : EntryPair::Zero();
    }
    // Joints between the body and the root: their motions, once for each of their entries.
    for (int index = body_index; index > 0; index = tree_.bodies()[index].parent) {
      const int dof = tree_.bodies()[index].dof;
      if (static_cast<int>(tree_.dof_ancestors(dof).size()) < 2 * pair) {
        if (is_in_series) break;
        continue;
      }
      const SpatialVector motion = bodies_[index].motion;
      const EntryPair entry = inverse_row(dof)[pair];
      sum[0] += motion.angular[0] * entry;
      sum[1] += motion.angular[1] * entry;
      sum[2] += motion.angular[2] * entry;
      sum[3] += motion.linear[0] * entry;
      sum[4] += motion.linear[1] * entry;
      sum[5] += motion.linear[2] * entry;
    }
    for (int axis = 0; axis < 6; ++axis) rows[axis * count + pair] = sum[axis];
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
