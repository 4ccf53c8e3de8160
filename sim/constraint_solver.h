#pragma once

#include <Eigen/Core>
#include <vector>

namespace nao::sim {

/** Part of one degree of freedom in the three rows of a contact block, or (row[0]) in a joint row:
 * entries of L^-T J^T, where J is the rows' Jacobian and M = L^T L the mass matrix with its
 * implicit diagonal. The fourth lane is padding for vector instructions. */
struct alignas(32) RowEntry {
  double row[4] = {0, 0, 0, 0};
};

/** Three rows of a contact: two bodies that press on each other at a point, or roll on each other.
 *
 * Pressing: row 0 is the velocity along the normal, rows 1 and 2 along the tangents. With impulse p
 * the normal row is the complementarity problem
 *
 *     0 <= p_0   and   v_0 + normal_softness p_0 + bias_0 >= 0,   one of them with equality;
 *
 * the tangential impulse brings v + tangent_softness p + bias to 0 as far as it stays in Coulomb's
 * cone, |p_12| <= friction p_0; beyond, it has that size and opposes sliding.
 * Rolling: the rows are relative angular velocities about the normal and the tangents. The impulses
 * are bounded by `spinning` and `friction` (m) times the normal impulse of the block before. */
struct ContactBlock {
  int first_entry = 0;
  int num_entries = 0;
  bool is_rolling = false;
  /** Coulomb's coefficient, or of a rolling block its lever arm, m. */
  double friction = 0;
  double spinning = 0;
  /** Velocity per impulse, m/s per N s: the regularization of a spring and a damper, see
   * ContactAssembler; and bias velocity, m/s. */
  double normal_softness = 0;
  double tangent_softness = 0;
  Eigen::Vector3d bias = Eigen::Vector3d::Zero();
  /** N s: start value, then solution. */
  Eigen::Vector3d impulse = Eigen::Vector3d::Zero();

  // Filled in by the solver.
  /** 1 / (J M^-1 J^T + softness) of the normal row. */
  double normal_inverse = 0;
  /** Inverse of the tangential 2 x 2 block of J M^-1 J^T + softness: xx, xy, yy. */
  double tangent_inverse[3] = {0, 0, 0};
  /** 1 / the larger eigenvalue of that block. */
  double tangent_step = 0;
};

/** A row on one joint: a stop, dry friction, or a motor at its torque limit.
 *
 * The impulse p acts along `apply` (+1 or -1) on the joint and stays in lower..upper; strictly
 * inside, measure * v + softness * p + bias = 0 for the joint's velocity v. */
struct JointRow {
  int first_entry = 0;
  int num_entries = 0;
  double apply = 1;
  double measure = 1;
  /** rad/s per N m s, and rad/s. */
  double softness = 0;
  double bias = 0;
  /** N m s. */
  double lower = 0;
  double upper = 0;
  double impulse = 0;

  // Filled in by the solver.
  /** 1 / (J M^-1 J^T + softness). */
  double inverse = 0;
};

/** Finds the impulses of all contacts and joint rows by projected Gauss-Seidel iterations, starting
 * from the last step's solution.
 *
 * One iteration solves row after row (block after block) for its own impulse with all others fixed,
 * and projects it onto its bounds: sequential impulses (E. Catto, Iterative Dynamics with Temporal
 * Coherence, GDC 2005; M. Anitescu and F. Potra, 1997, for the time-stepping problem). The softness
 * on the diagonal regularizes redundant contacts and makes the solution unique.
 *
 * The unknown is z = L u, the generalized velocity u scaled by the mass matrix's factor: an impulse
 * p of a row with entries y = L^-T J^T changes z by y p, and J u = y . z, so that no row needs
 * M^-1. The caller gets u = L^-1 z. Memory is taken once, in reserve(). */
class ConstraintSolver {
 public:
  struct Options {
    int max_iterations = 50;
    /** An iteration that changes no row's velocity by more, m/s or rad/s, is the last. */
    double tolerance = 1e-5;
  };

  /** Takes memory. @param max_blocks, max_rows, max_entries  Most that a step may add. */
  void reserve(int max_blocks, int max_rows, int max_entries);

  /** Removes all constraints. */
  void clear();

  /** Adds entries for a dof each and returns the first's index, or -1 if memory is used up. */
  int add_entries(int count);
  /** Index of an entry's degree of freedom in the scaled velocity. */
  int& dof(int entry) { return dofs_[entry]; }
  RowEntry& entry(int entry) { return entries_[entry]; }

  /** Adds a constraint; its entries must be complete. @return Index, or -1 without memory. */
  int add_block(const ContactBlock& block);
  int add_row(const JointRow& row);
  /** Gives a row other values; it keeps its impulse. */
  void replace_row(int index, const JointRow& row);

  /** Applies the start values to the scaled velocity. Call once, before solve(); rows added later
   * must start at impulse 0. */
  void warm_start(Eigen::VectorXd& scaled_velocity) const;
  /** Iterates until converged. @return Number of iterations. */
  int solve(Eigen::VectorXd& scaled_velocity, const Options& options);

  const std::vector<ContactBlock>& blocks() const { return blocks_; }
  const std::vector<JointRow>& rows() const { return rows_; }

 private:
  /** Solve one constraint. @param normal_impulse  Of the block before, N s; for rolling blocks.
   * @return By how much its velocity was off, m/s or rad/s. */
  double solve_block(ContactBlock& block, double normal_impulse, double* z) const;
  double solve_row(JointRow& row, double* z) const;

  std::vector<ContactBlock> blocks_;
  std::vector<JointRow> rows_;
  std::vector<RowEntry> entries_;
  std::vector<int> dofs_;
  int num_entries_ = 0;
};

}  // namespace nao::sim
