#pragma once

#include <array>
#include <vector>

#include "sim/entry_pair.h"

namespace nao::sim {

/** Solves the contacts that act on one chain of degrees of freedom together, by a Newton step.
 *
 * Gauss-Seidel iterations converge slowly where many contacts bear a heavy robot through a light
 * body: a foot whose ankle is free in its backlash is moved by each of its contacts alone, but all
 * of them together bear the robot. Without these steps every third time step of a walk with
 * backlash ended unconverged; over-relaxation, symmetric sweeps and a conjugate gradient method did
 * not help.
 *
 * Velocity and impulses p_i of the rows y_i that press or stick, with softness s_i > 0 and bias
 * b_i, obey
 *
 *     y_i . z + s_i p_i + b_i = 0,   z = z_0 + sum_i y_i (p_i - p_0i).
 *
 * With the errors e_i = y_i . z_0 + s_i p_0i + b_i at the start, elimination of the impulses gives
 *
 *     (1 + sum_i y_i y_i^T / s_i) (z - z_0) = -sum_i y_i e_i / s_i,
 *     p_i - p_0i = -(e_i + y_i . (z - z_0)) / s_i.
 *
 * The step ends where a contact would begin to pull. What presses or sticks is left to the
 * iterations. It is the Newton method of MuJoCo's solver (E. Todorov, Convex and analytically-
 * invertible dynamics with contacts and constraints, ICRA 2014) for one chain. */
class ChainNewton {
 public:
  /** Most pairs of a chain. Chosen: a limb and the root's six degrees of freedom. */
  static constexpr int kMaxPairs = 8;

  /** Allocates memory. @param max_rows  Most rows of a step. */
  void reserve(int max_rows) { rows_.reserve(max_rows); }

  void clear() { rows_.clear(); }
  /** Adds a row; the parameters are as in ContactBlock. A normal impulse stays 0 or more. */
  void add_normal(double& impulse, const EntryPair* entries, double softness, double bias) {
    rows_.push_back({&impulse, entries, softness, bias, true});
  }
  void add_tangent(double& impulse, const EntryPair* entries, double softness, double bias) {
    rows_.push_back({&impulse, entries, softness, bias, false});
  }
  /** Changes the rows' impulses and z, the chain's part of the scaled velocity.
   * @param num_pairs  Of z and of each row, kMaxPairs at most. */
  void solve(EntryPair* z, int num_pairs);

 private:
  struct Row {
    double* impulse;
    const EntryPair* entries;
    double softness;
    double bias;
    bool is_normal;
    double error = 0;
    double change = 0;
  };

  template <class Count>
  void solve_pairs(EntryPair* z, Count num_pairs);

  std::vector<Row> rows_;
  /** The matrix, line by line; of each line, the pairs from the diagonal on. */
  std::array<EntryPair, 2 * kMaxPairs * kMaxPairs> matrix_;
};

}  // namespace nao::sim
