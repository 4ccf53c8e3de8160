#include "sim/chain_newton.h"

#include <algorithm>

#include "sim/constant_count.h"

namespace nao::sim {

template <class Count>
void ChainNewton::solve_pairs(EntryPair* z, Count num_pairs) {
  const int num_dofs = 2 * num_pairs;
  const auto line = [this](int i) { return &matrix_[i * kMaxPairs]; };
  // The right-hand side, then the change of z.
  std::array<EntryPair, kMaxPairs> change;
  double* value = change[0].data();
  for (int k = 0; k < num_pairs; ++k) change[k].setZero();
  for (int i = 0; i < num_dofs; ++i) {
    for (int k = i / 2; k < num_pairs; ++k) line(i)[k].setZero();
    line(i)[i / 2][i % 2] = 1;
  }
  for (Row& row : rows_) {
    row.error = dot(row.entries, z, num_pairs) + row.softness * *row.impulse + row.bias;
    const double weight = 1 / row.softness;
    for (int k = 0; k < num_pairs; ++k) change[k] -= row.entries[k] * (row.error * weight);
    for (int i = 0; i < num_dofs; ++i) {
      const double factor = row.entries[i / 2][i % 2] * weight;
      for (int k = i / 2; k < num_pairs; ++k) line(i)[k] += row.entries[k] * factor;
    }
  }

  // Gaussian elimination without pivots: the matrix is symmetric, no eigenvalue is below 1.
  std::array<double, 2 * kMaxPairs> inverse;
  for (int i = 0; i < num_dofs; ++i) {
    const double* top = line(i)->data();
    inverse[i] = 1 / top[i];
    for (int below = i + 1; below < num_dofs; ++below) {
      const double factor = top[below] * inverse[i];
      for (int k = below / 2; k < num_pairs; ++k) line(below)[k] -= line(i)[k] * factor;
      value[below] -= value[i] * factor;
    }
  }
  for (int i = num_dofs - 1; i >= 0; --i) {
    for (int k = i + 1; k < num_dofs; ++k) value[i] -= line(i)->data()[k] * value[k];
    value[i] *= inverse[i];
  }

  double share = 1;
  for (Row& row : rows_) {
    row.change = -(row.error + dot(row.entries, change.data(), num_pairs)) / row.softness;
    if (row.is_normal && *row.impulse + row.change < 0) {
      share = std::min(share, -*row.impulse / row.change);
    }
  }
  for (const Row& row : rows_) *row.impulse += share * row.change;
  for (int k = 0; k < num_pairs; ++k) z[k] += share * change[k];
}

void ChainNewton::solve(EntryPair* z, int num_pairs) {
  with_constant<6, 6>(num_pairs, [&](auto count) { solve_pairs(z, count); });
}

}  // namespace nao::sim
