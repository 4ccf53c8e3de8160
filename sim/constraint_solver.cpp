#include "sim/constraint_solver.h"

#include <algorithm>
#include <cmath>

#include "sim/constant_count.h"

namespace nao::sim {
namespace {

/** Of a NAO's and other humanoids' limbs. */
template <class Work>
[[gnu::always_inline]] inline auto with_constant_pairs(int count, Work work) {
  return with_constant<4, 6>(count, work);
}

// Eigenvalues of a symmetric 2 x 2 matrix are mean +- sqrt(mean^2 - determinant); rounding may make
// the root's argument slightly negative.
double calc_tangent_step(const ContactBlock& block) {
  const double mean = block.tangent_mean;
  return 1 / (mean + std::sqrt(std::max(0.0, mean * mean - block.tangent_determinant)));
}

// Chains are solved together in every third iteration from the sixth on. Chosen: a walk of a used
// robot takes two thirds of the time, one without backlash as long as before.
constexpr int kFirstChainStep = 6;
constexpr int kChainStepPeriod = 3;
// A tangential impulse up to this fraction of its bound sticks. Chosen: less than the last digits
// that the projection onto the bound loses.
constexpr double kSticking = 0.999;

// Solve one constraint. normal_impulse: of the block before, N s; for rolling blocks. z: of the
// constraint's chain. They return the error of its velocity before, m/s or rad/s.

template <class Count>
[[gnu::always_inline]] inline double solve_block(ContactBlock& block, Count count,
                                                 double normal_impulse, EntryPair* z) {
  const EntryPair* row_n = block.entries;
  const EntryPair* row_x = row_n + count;
  const EntryPair* row_y = row_x + count;
  // Velocities of the rows, J u = y . z.
  const double vn = dot(row_n, z, count);
  const double vx = dot(row_x, z, count);
  const double vy = dot(row_y, z, count);
  const double before_n = block.impulse[0];
  const double before_x = block.impulse[1];
  const double before_y = block.impulse[2];
  // What the normal impulse would be without bounds: one Gauss-Seidel step with the diagonal entry,
  // for the equality v + softness * p + bias = 0. The velocity comes last in all sums here, since
  // the next constraint waits for what follows from it.
  const double unbounded =
      before_n - (block.normal_softness * before_n + block.bias[0]) * block.normal_inverse -
      vn * block.normal_inverse;
  // A pressing contact opens where it would pull (projection on p >= 0). A rolling block has no
  // normal impulse of its own: it takes that of the pressing block before, and brings the rotation
  // about the normal to 0 with a bounded torque impulse.
  const double limit = block.spinning * normal_impulse;
  const double normal =
      block.is_rolling ? std::clamp(unbounded, -limit, limit) : std::max(0.0, unbounded);
  const double change_n = normal - before_n;
  // Radius of the friction cone, of the new normal impulse and not of the last iteration's.
  const double bound = block.friction * (block.is_rolling ? normal_impulse : normal);
  // Tangential impulse that would stop the sliding: Newton step with the 2 x 2 block. The change of
  // the normal impulse changes the tangential velocities.
  const double rx = vx + (block.tangent_softness * before_x + block.bias[1]);
  const double ry = vy + (block.tangent_softness * before_y + block.bias[2]);
  double x = before_x - (block.tangent_inverse[0] * rx + block.tangent_inverse[1] * ry) -
             block.coupling_step[0] * change_n;
  double y = before_y - (block.tangent_inverse[1] * rx + block.tangent_inverse[2] * ry) -
             block.coupling_step[1] * change_n;
  if (x * x + y * y > bound * bound) {
    // It slides. Where the inertia is not the same in all directions, the Newton step is not
    // parallel to the residual, and its projection would not oppose the sliding. A gradient step is
    // parallel (projected gradient method, with the step length 1 / the largest eigenvalue).
    if (block.tangent_step == 0) block.tangent_step = calc_tangent_step(block);
    const double step = block.tangent_step;
    x = before_x - step * (rx + block.coupling[0] * change_n);
    y = before_y - step * (ry + block.coupling[1] * change_n);
    const double square = x * x + y * y;
    if (square > bound * bound) {
      const double scale = bound / std::sqrt(square);
      x *= scale;
      y *= scale;
    }
  }
  // The new impulses are known; z takes their change, so that the next row sees it (Gauss-Seidel,
  // in contrast to Jacobi).
  const double change_x = x - before_x;
  const double change_y = y - before_y;
  for (int i = 0; i < count; ++i) {
    z[i] = z[i] + row_n[i] * change_n + row_x[i] * change_x + row_y[i] * change_y;
  }
  block.impulse[0] = normal;
  block.impulse[1] = x;
  block.impulse[2] = y;
  // The change of impulse in terms of velocity: by how much the rows were off.
  const double tangent = (std::abs(change_x) + std::abs(change_y)) * block.tangent_scale;
  return std::max(std::abs(change_n) * block.normal_scale, tangent);
}

template <class Count>
[[gnu::always_inline]] inline double solve_row(JointRow& row, Count count, EntryPair* z) {
  const EntryPair* entries = row.entries;
  // J u = y . z.
  const double velocity = dot(entries, z, count);
  // Gauss-Seidel step on the row's own impulse, projected onto [lower, upper]. The velocity comes
  // last, as the next constraint waits for it.
  const double unbounded =
      row.impulse - (row.softness * row.impulse + row.bias) * row.inverse - velocity * row.gain;
  const double impulse = std::clamp(unbounded, row.lower, row.upper);
  const double change = impulse - row.impulse;
  if (change == 0) return 0;
  row.impulse = impulse;
  const double applied = row.apply * change;
  for (int i = 0; i < count; ++i) z[i] += entries[i] * applied;
  return std::abs(change) * row.scale;
}
}  // namespace

ContactBlock::ContactBlock() = default;
JointRow::JointRow() = default;

void ConstraintSolver::reserve(int max_blocks, int max_rows, int max_chains, int max_chain,
                               int max_pairs) {
  blocks_.reserve(max_blocks);
  rows_.reserve(max_rows);
  chains_.reserve(max_chains);
  chain_dofs_.reserve(static_cast<size_t>(max_chains) * max_chain);
  entries_.resize(max_pairs);
  local_.resize(num_pairs(max_chain));
  newton_.reserve(3 * max_blocks);
}

void ConstraintSolver::clear() {
  blocks_.clear();
  rows_.clear();
  chains_.clear();
  chain_dofs_.clear();
  num_entries_ = 0;
}

// If the memory is full, the caller leaves its constraint out, and the stepper counts it as
// dropped. No memory is allocated while the simulation runs.
int ConstraintSolver::add_chain(const int* dofs, int count, int first_dof) {
  if (chains_.size() == chains_.capacity() || chain_dofs_.size() + count > chain_dofs_.capacity() ||
      num_pairs(count) > static_cast<int>(local_.size())) {
    return -1;
  }
  const int first = static_cast<int>(chain_dofs_.size());
  for (int i = 0; i < count; ++i) chain_dofs_.push_back(first_dof + dofs[i]);
  const int most = chains_.empty() ? count : std::min(count, chains_[0].count);
  int num_shared = 0;
  while (num_shared < most && chain_dofs_[first + num_shared] == chain_dofs_[num_shared]) {
    ++num_shared;
  }
  chains_.push_back({first, count, num_shared});
  return static_cast<int>(chains_.size()) - 1;
}

EntryPair* ConstraintSolver::add_entries(int num_pairs) {
  if (num_entries_ + num_pairs > static_cast<int>(entries_.size())) return nullptr;
  EntryPair* first = &entries_[num_entries_];
  num_entries_ += num_pairs;
  return first;
}

ContactBlock* ConstraintSolver::begin_block() {
  return blocks_.size() == blocks_.capacity() ? nullptr : &blocks_.emplace_back();
}

int ConstraintSolver::end_block() {
  ContactBlock& block = blocks_.back();
  // The block's part of J M^-1 J^T = y^T y. n is the normal row, x and y are the two tangent rows.
  const EntryPair* n = block.entries;
  double xx = block.tangent_softness;
  double xy = 0;
  double yy = block.tangent_softness;
  with_constant_pairs(num_pairs_of(block.chain), [&](auto count) {
    const EntryPair* x = n + count;
    const EntryPair* y = x + count;
    block.coupling[0] = dot(n, x, count);
    block.coupling[1] = dot(n, y, count);
    block.normal_scale = dot(n, n, count) + block.normal_softness;
    xx += dot(x, x, count);
    xy = dot(x, y, count);
    yy += dot(y, y, count);
  });
  // Inverse of the symmetric 2 x 2 matrix [xx, xy; xy, yy].
  const double determinant = xx * yy - xy * xy;
  block.normal_inverse = 1 / block.normal_scale;
  block.tangent_inverse[0] = yy / determinant;
  block.tangent_inverse[1] = -xy / determinant;
  block.tangent_inverse[2] = xx / determinant;
  // The change of the normal impulse does not turn what rolls.
  if (block.is_rolling) block.coupling[0] = block.coupling[1] = 0;
  for (int k = 0; k < 2; ++k) {
    block.coupling_step[k] = block.tangent_inverse[k] * block.coupling[0] +
                             block.tangent_inverse[k + 1] * block.coupling[1];
  }
  block.tangent_scale = 1 / std::max(block.tangent_inverse[0], block.tangent_inverse[2]);
  block.tangent_mean = (xx + yy) / 2;
  block.tangent_determinant = determinant;
  return static_cast<int>(blocks_.size()) - 1;
}

JointRow* ConstraintSolver::begin_row() {
  return rows_.size() == rows_.capacity() ? nullptr : &rows_.emplace_back();
}

int ConstraintSolver::end_row() {
  complete(rows_.back());
  return static_cast<int>(rows_.size()) - 1;
}

void ConstraintSolver::complete(JointRow& row) {
  // Diagonal entry of the regularized row. A torque bound measures against the direction in which
  // it acts; its entry is positive in both cases: softness is 1 / (h slope), and the joint has h
  // slope on the diagonal of the implicit mass matrix, so that measure * apply * diagonal >=
  // -softness.
  row.scale = row.measure * row.apply * row.diagonal + row.softness;
  row.inverse = 1 / row.scale;
  row.gain = row.measure * row.inverse;
}

void ConstraintSolver::change_chain(int chain, double* z) {
  const Chain& entered = chains_[chain];
  const int* dofs = &chain_dofs_[entered.first];
  double* local = local_.data()->data();
  int i = 0;
  if (entered_ >= 0) {
    const Chain& left = chains_[entered_];
    const int* left_dofs = &chain_dofs_[left.first];
    i = std::min(entered.num_shared, left.num_shared);
    for (int k = i; k < left.count; ++k) z[left_dofs[k]] = local[k];
  }
  for (; i < entered.count; ++i) local[i] = z[dofs[i]];
  // The partner of a last odd entry, which the rows' entries multiply by 0.
  if (entered.count % 2 != 0) local[entered.count] = 0;
  entered_ = chain;
}

void ConstraintSolver::leave(double* z) {
  if (entered_ < 0) return;
  const Chain& entered = chains_[entered_];
  const int* dofs = &chain_dofs_[entered.first];
  const double* local = local_.data()->data();
  for (int i = 0; i < entered.count; ++i) z[dofs[i]] = local[i];
  entered_ = -1;
}

void ConstraintSolver::warm_start(Eigen::VectorXd& scaled_velocity) {
  // z := z + y p for all start values p; afterwards z and the impulses belong together, which every
  // solve_block() and solve_row() keeps.
  double* z = scaled_velocity.data();
  EntryPair* local = local_.data();
  for (const ContactBlock& block : blocks_) {
    enter(block.chain, z);
    const EntryPair* entries = block.entries;
    with_constant_pairs(num_pairs_of(block.chain), [&](auto count) {
      for (int i = 0; i < count; ++i) {
        local[i] += entries[i] * block.impulse[0] + entries[count + i] * block.impulse[1] +
                    entries[2 * count + i] * block.impulse[2];
      }
    });
  }
  for (const JointRow& row : rows_) {
    enter(row.chain, z);
    const double applied = row.apply * row.impulse;
    for (int i = 0; i < row.num_pairs; ++i) local[i] += row.entries[i] * applied;
  }
  leave(z);
}

// Of a sliding contact only the normal row: the next iteration turns its friction.
void ConstraintSolver::step_chains(double* z) {
  for (size_t first = 0, end = 0; first < blocks_.size(); first = end) {
    const int chain = blocks_[first].chain;
    const int count = num_pairs_of(chain);
    newton_.clear();
    for (; end < blocks_.size() && blocks_[end].chain == chain; ++end) {
      ContactBlock& block = blocks_[end];
      if (block.is_rolling || block.impulse[0] <= 0) continue;
      newton_.add_normal(block.impulse[0], block.entries, block.normal_softness, block.bias[0]);
      const double bound = kSticking * block.friction * block.impulse[0];
      if (block.impulse.tail<2>().squaredNorm() > bound * bound) continue;
      for (int k = 1; k < 3; ++k) {
        newton_.add_tangent(block.impulse[k], block.entries + k * count, block.tangent_softness,
                            block.bias[k]);
      }
    }
    if (end - first < 2 || count > ChainNewton::kMaxPairs) continue;
    enter(chain, z);
    newton_.solve(local_.data(), count);
  }
}

// Joint rows first: torque bounds and dry friction settle before contacts see the velocities, and a
// rolling block follows the pressing block that gives its normal impulse. Stops at the first
// iteration that changes no row's velocity by more than the tolerance. Without convergence the last
// iterate is taken: it satisfies all bounds, only velocities are off by the residual.
int ConstraintSolver::solve(Eigen::VectorXd& scaled_velocity, const Options& options) {
  if (blocks_.empty() && rows_.empty()) return 0;
  double* z = scaled_velocity.data();
  EntryPair* local = local_.data();
  for (int iteration = 1;; ++iteration) {
    double worst = 0;
    for (JointRow& row : rows_) {
      enter(row.chain, z);
      worst = std::max(worst, with_constant_pairs(row.num_pairs, [&](auto count) {
                         return solve_row(row, count, local);
                       }));
    }
    double normal_impulse = 0;
    for (ContactBlock& block : blocks_) {
      enter(block.chain, z);
      worst = std::max(worst, with_constant_pairs(num_pairs_of(block.chain), [&](auto count) {
                         return solve_block(block, count, normal_impulse, local);
                       }));
      normal_impulse = block.impulse[0];
    }
    if (iteration >= options.max_iterations || worst < options.tolerance) {
      leave(z);
      return iteration;
    }
    if (iteration >= kFirstChainStep && iteration % kChainStepPeriod == 0) step_chains(z);
  }
}

}  // namespace nao::sim
