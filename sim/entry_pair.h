#pragma once

#include <Eigen/Core>

namespace nao::sim {

/** Two entries of a row, for two degrees of freedom one after the other: one vector instruction
 * works on both. A row of an odd number of entries ends with a 0. */
using EntryPair = Eigen::Array2d;

/** Pairs of a row that has `count` entries. */
constexpr int num_pairs(int count) {
  return (count + 1) / 2;
}

/** Scalar product. Two sums side by side, so that additions need not wait for each other.
 * @param count  2 or more. */
template <class Count>
[[gnu::always_inline]] inline double dot(const EntryPair* a, const EntryPair* b, Count count) {
  EntryPair even = a[0] * b[0];
  EntryPair odd = a[1] * b[1];
  int i = 2;
  for (; i + 1 < count; i += 2) {
    even += a[i] * b[i];
    odd += a[i + 1] * b[i + 1];
  }
  if (i < count) even += a[i] * b[i];
  return (even + odd).sum();
}

}  // namespace nao::sim
