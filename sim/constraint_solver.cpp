#include "sim/constraint_solver.h"

#include <algorithm>
#include <cmath>

namespace nao::sim {

void ConstraintSolver::reserve(int max_blocks, int max_rows, int max_entries) {
  blocks_.reserve(max_blocks);
  rows_.reserve(max_rows);
  entries_.resize(max_entries);
  dofs_.resize(max_entries);
}

void ConstraintSolver::clear() {
  blocks_.clear();
  rows_.clear();
  num_entries_ = 0;
}

int ConstraintSolver::add_entries(int count) {
  // Full: the caller leaves its constraint out, and the stepper counts it as dropped. No memory is
  // taken while the simulation runs.
  if (num_entries_ + count > static_cast<int>(entries_.size())) return -1;
  const int first = num_entries_;
  num_entries_ += count;
  return first;
}

int ConstraintSolver::add_block(const ContactBlock& added) {
  if (blocks_.size() == blocks_.capacity()) return -1;
  ContactBlock block = added;
  // The block's part of J M^-1 J^T = y^T y; normal and tangents are solved one after the other, so
  // that their coupling does not enter here.
  // n is the normal row, x and y are the two tangent rows: entries of the 3 x 3 matrix y^T y.
  double nn = 0, xx = 0, xy = 0, yy = 0;
  for (int i = 0; i < block.num_entries; ++i) {
    const double* row = entries_[block.first_entry + i].row;
    nn += row[0] * row[0];
    xx += row[1] * row[1];
    xy += row[1] * row[2];
    yy += row[2] * row[2];
  }
  xx += block.tangent_softness;
  yy += block.tangent_softness;
  // Inverse of the symmetric 2 x 2 matrix [xx, xy; xy, yy].
  const double determinant = xx * yy - xy * xy;
  block.normal_inverse = 1 / (nn + block.normal_softness);
  block.tangent_inverse[0] = yy / determinant;
  block.tangent_inverse[1] = -xy / determinant;
  block.tangent_inverse[2] = xx / determinant;
  // Eigenvalues of a symmetric 2 x 2 matrix are mean +- sqrt(mean^2 - determinant); rounding may
  // make the root's argument slightly negative.
  // One over the larger eigenvalue.
  const double mean = (xx + yy) / 2;
  block.tangent_step = 1 / (mean + std::sqrt(std::max(0.0, mean * mean - determinant)));
  blocks_.push_back(block);
  return static_cast<int>(blocks_.size()) - 1;
}

int ConstraintSolver::add_row(const JointRow& row) {
  if (rows_.size() == rows_.capacity()) return -1;
  rows_.push_back(row);
  const int index = static_cast<int>(rows_.size()) - 1;
  replace_row(index, row);
  return index;
}

void ConstraintSolver::replace_row(int index, const JointRow& other) {
  // The impulse is kept: the solver is in the middle of its iterations, and z contains this impulse
  // already. The row's entries must be the same as before.
  const double impulse = rows_[index].impulse;
  JointRow& row = rows_[index];
  row = other;
  row.impulse = impulse;
  double diagonal = 0;
  for (int i = 0; i < row.num_entries; ++i) {
    const double y = entries_[row.first_entry + i].row[0];
    diagonal += y * y;
  }
  // Diagonal entry of the regularized row. A torque bound measures against the direction in which
  // it acts; its entry is positive all the same: softness is 1 / (h slope), and the joint has h
  // slope on the diagonal of the implicit mass matrix, so that measure * apply * diagonal >=
  // -softness.
  row.inverse = 1 / (row.measure * row.apply * diagonal + row.softness);
}

void ConstraintSolver::warm_start(Eigen::VectorXd& z) const {
  // z := z + y p for all start values p; afterwards z and the impulses belong together, which every
  // solve_block() and solve_row() keeps.
  for (const ContactBlock& block : blocks_) {
    for (int i = block.first_entry; i < block.first_entry + block.num_entries; ++i) {
      const double* row = entries_[i].row;
      z[dofs_[i]] +=
          row[0] * block.impulse[0] + row[1] * block.impulse[1] + row[2] * block.impulse[2];
    }
  }
  for (const JointRow& row : rows_) {
    for (int i = row.first_entry; i < row.first_entry + row.num_entries; ++i) {
      z[dofs_[i]] += entries_[i].row[0] * row.apply * row.impulse;
    }
  }
}

double ConstraintSolver::solve_block(ContactBlock& block, double normal_impulse, double* z) const {
  const RowEntry* entries = &entries_[block.first_entry];
  const int* dofs = &dofs_[block.first_entry];
  // Velocities of the rows, J u = y . z.
  double v[4] = {0, 0, 0, 0};
  // The fourth lane is padding that is always 0; four lanes make one vector instruction.
  for (int i = 0; i < block.num_entries; ++i) {
    const double value = z[dofs[i]];
    for (int lane = 0; lane < 4; ++lane) v[lane] += entries[i].row[lane] * value;
  }
  double change[4] = {0, 0, 0, 0};
  // A rolling block has no normal impulse of its own: it takes that of the pressing block before.
  // Radius of the friction cone.
  double bound = block.friction * normal_impulse;
  if (block.is_rolling) {
    // Torsional (spinning) resistance about the normal: brings the rotation about the normal to 0,
    // with a torque impulse of at most `limit`.
    const double limit = block.spinning * normal_impulse;
    const double unbounded = block.impulse[0] - (v[0] + block.bias[0]) * block.normal_inverse;
    change[0] = std::clamp(unbounded, -limit, limit) - block.impulse[0];
  } else {
    // Residual of the complementarity problem's equality v + softness * p + bias = 0, and one
    // Gauss-Seidel step with the diagonal entry; projection on p >= 0 opens the contact.
    const double residual = v[0] + block.normal_softness * block.impulse[0] + block.bias[0];
    const double normal = std::max(0.0, block.impulse[0] - residual * block.normal_inverse);
    change[0] = normal - block.impulse[0];
    // The cone of the new normal impulse, not of the last iteration's.
    bound = block.friction * normal;
    // The change of the normal impulse changes the tangential velocities.
    double coupling[2] = {0, 0};
    for (int i = 0; i < block.num_entries; ++i) {
      const double scaled = entries[i].row[0] * change[0];
      coupling[0] += entries[i].row[1] * scaled;
      coupling[1] += entries[i].row[2] * scaled;
    }
    v[1] += coupling[0];
    v[2] += coupling[1];
  }
  // Tangential impulse that would stop the sliding: Newton step with the 2 x 2 block.
  const double rx = v[1] + block.tangent_softness * block.impulse[1] + block.bias[1];
  const double ry = v[2] + block.tangent_softness * block.impulse[2] + block.bias[2];
  double x = block.impulse[1] - (block.tangent_inverse[0] * rx + block.tangent_inverse[1] * ry);
  double y = block.impulse[2] - (block.tangent_inverse[1] * rx + block.tangent_inverse[2] * ry);
  if (x * x + y * y > bound * bound) {
    // It slides. Where the inertia is not the same in all directions, the Newton step is not
    // parallel to the residual, and its projection would not oppose the sliding. A gradient step is
    // parallel (projected gradient method, with the step length 1 / the largest eigenvalue).
    const double step = block.tangent_step;
    x = block.impulse[1] - step * rx;
    y = block.impulse[2] - step * ry;
    const double square = x * x + y * y;
    if (square > bound * bound) {
      const double scale = bound / std::sqrt(square);
      x *= scale;
      y *= scale;
    }
  }
  // The new impulses are known; z takes their change, so that the next row sees it (Gauss-Seidel,
  // in contrast to Jacobi).
  change[1] = x - block.impulse[1];
  change[2] = y - block.impulse[2];
  for (int i = 0; i < block.num_entries; ++i) {
    const double* row = entries[i].row;
    z[dofs[i]] += row[0] * change[0] + row[1] * change[1] + row[2] * change[2];
  }
  for (int k = 0; k < 3; ++k) block.impulse[k] += change[k];
  // The change of impulse in terms of velocity: by how much the rows were off.
  const double tangent = (std::abs(change[1]) + std::abs(change[2])) /
                         std::max(block.tangent_inverse[0], block.tangent_inverse[2]);
  return std::max(std::abs(change[0]) / block.normal_inverse, tangent);
}

double ConstraintSolver::solve_row(JointRow& row, double* z) const {
  const RowEntry* entries = &entries_[row.first_entry];
  const int* dofs = &dofs_[row.first_entry];
  // J u = y . z; a joint row has one direction, so that only lane 0 counts.
  double velocity = 0;
  for (int i = 0; i < row.num_entries; ++i) velocity += entries[i].row[0] * z[dofs[i]];
  const double residual = row.measure * velocity + row.softness * row.impulse + row.bias;
  // Gauss-Seidel step on the row's own impulse, projected onto [lower, upper].
  const double impulse = std::clamp(row.impulse - residual * row.inverse, row.lower, row.upper);
  const double change = impulse - row.impulse;
  if (change == 0) return 0;
  row.impulse = impulse;
  const double applied = row.apply * change;
  for (int i = 0; i < row.num_entries; ++i) z[dofs[i]] += entries[i].row[0] * applied;
  return std::abs(change) / row.inverse;
}

// Joint rows first: torque bounds and dry friction settle before contacts see the velocities, and a
// rolling block follows the pressing block that gives its normal impulse. Stops at the first
// iteration that changes no row's velocity by more than the tolerance. Without convergence the last
// iterate is taken: it satisfies all bounds, only velocities are off by the residual.
int ConstraintSolver::solve(Eigen::VectorXd& z, const Options& options) {
  if (blocks_.empty() && rows_.empty()) return 0;
  for (int iteration = 1; iteration <= options.max_iterations; ++iteration) {
    double worst = 0;
    for (JointRow& row : rows_) worst = std::max(worst, solve_row(row, z.data()));
    double normal_impulse = 0;
    for (ContactBlock& block : blocks_) {
      worst = std::max(worst, solve_block(block, normal_impulse, z.data()));
      normal_impulse = block.impulse[0];
    }
    if (worst < options.tolerance) return iteration;
  }
  return options.max_iterations;
}

}  // namespace nao::sim
