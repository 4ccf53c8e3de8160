#pragma once

#include <Eigen/Core>
#include <vector>

namespace nao::sim {

/** One velocity coordinate's part in three constraint rows: entries of L^-T J^T, where M = L^T L.
 * The fourth lane only pads. */
struct alignas(32) RowEntry {
  double row[4] = {0, 0, 0, 0};
};

/** Two bodies that press on each other at a point, or roll on each other: three rows.
 *
 * Pressing: row 0 along the normal, rows 1 and 2 along the tangents. The normal impulse p pushes
 * only; a spring and damper entered implicitly keep velocity + softness * p + bias at 0 or above.
 * The tangential impulse lies in Coulomb's cone: at most friction * p, directed against sliding.
 * Rolling: the rows are relative angular velocities, about the normal and the tangents, bounded by
 * `spinning` and `rolling` (m) times the normal impulse of the block before. */
struct ContactBlock {
  int first_entry = 0;
  int num_entries = 0;
  bool is_rolling = false;
  double friction = 0;
  double spinning = 0;
  /** Velocity per impulse, m/s per N s, and m/s. */
  double normal_softness = 0;
  double tangent_softness = 0;
  Eigen::Vector3d bias = Eigen::Vector3d::Zero();
  /** N s: start value, then solution. */
  Eigen::Vector3d impulse = Eigen::Vector3d::Zero();

  // Filled in by the solver.
  double normal_inverse = 0;
  /** Inverse of the tangential 2 x 2 block: xx, xy, yy. */
  double tangent_inverse[3] = {0, 0, 0};
  double tangent_step = 0;
};

/** A bound on one joint: a stop, dry friction, or a motor at the end of its torque.
 *
 * The impulse acts along `apply` (+1 or -1) and stays in lower..upper; while inside, the solver
 * brings measure * velocity + softness * impulse + bias to 0. */
struct JointRow {
  int first_entry = 0;
  int num_entries = 0;
  double apply = 1;
  double measure = 1;
  double softness = 0;
  double bias = 0;
  double lower = 0;
  double upper = 0;
  double impulse = 0;

  // Filled in by the solver.
  double inverse = 0;
};

/** Finds the impulses of all contacts and joint bounds by projected Gauss-Seidel, starting from
 * the last step's.
 *
 * Works on z = L u, in which each impulse is a rank-one change; the caller gets the velocities
 * back as u = L^-1 z. Memory is taken once, in reserve(). */
class ConstraintSolver {
 public:
  struct Options {
    int max_sweeps = 50;
    /** A sweep that changes no row's velocity by more, m/s or rad/s, is the last. */
    double tolerance = 1e-5;
  };

  /** Takes memory. @param max_blocks, max_rows, max_entries  Most that a step may add. */
  void reserve(int max_blocks, int max_rows, int max_entries);

  /** Forgets all constraints. */
  void clear();

  /** Adds entries for a dof each and returns the first's index, or -1 if memory is used up. */
  int add_entries(int count);
  int& dof(int entry) { return dofs_[entry]; }
  RowEntry& entry(int entry) { return entries_[entry]; }

  /** Adds a constraint; its entries must be complete. @return Index, or -1 without memory. */
  int add_block(const ContactBlock& block);
  int add_row(const JointRow& row);
  /** Gives a row other values; it keeps its impulse. */
  void replace_row(int index, const JointRow& row);

  /** Applies the start values. Call once, after z has been set up; rows added later must start at
   * impulse 0. */
  void warm_start(Eigen::VectorXd& z) const;
  /** Sweeps until converged. @return Sweeps made. */
  int solve(Eigen::VectorXd& z, const Options& options);

  const std::vector<ContactBlock>& blocks() const { return blocks_; }
  const std::vector<JointRow>& rows() const { return rows_; }

 private:
  double solve_block(ContactBlock& block, double normal_impulse, double* z) const;
  double solve_row(JointRow& row, double* z) const;

  std::vector<ContactBlock> blocks_;
  std::vector<JointRow> rows_;
  std::vector<RowEntry> entries_;
  std::vector<int> dofs_;
  int num_entries_ = 0;
};

}  // namespace nao::sim
