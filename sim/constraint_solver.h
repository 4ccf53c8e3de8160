#pragma once

#include <Eigen/Core>
#include <vector>

#include "sim/chain_newton.h"
#include "sim/entry_pair.h"

namespace nao::sim {

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
  // As ContactCandidate's.
  ContactBlock();

  /** The solver's chain of degrees of freedom that the rows act on. */
  int chain = -1;
  /** Entries of L^-T J^T, where J is the rows' Jacobian and M = L^T L the mass matrix with its
   * implicit diagonal: row by row, for all dofs of the chain. */
  const EntryPair* entries = nullptr;
  bool is_rolling = false;
  /** Coulomb's coefficient; for a rolling block, its lever arm, m. */
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
  /** J M^-1 J^T + softness of the normal row, and its inverse. */
  double normal_scale = 0;
  double normal_inverse = 0;
  /** Entries of J M^-1 J^T of the normal row with the tangential ones. */
  double coupling[2] = {0, 0};
  /** Inverse of the tangential 2 x 2 block of J M^-1 J^T + softness: xx, xy, yy. */
  double tangent_inverse[3] = {0, 0, 0};
  /** The inverse times the coupling. */
  double coupling_step[2] = {0, 0};
  /** 1 / the larger eigenvalue of that block, found when the contact slides first; 0 until then. */
  double tangent_step = 0;
  /** Half the trace of that block, and its determinant. */
  double tangent_mean = 0;
  double tangent_determinant = 0;
  /** 1 / the larger diagonal entry of its inverse: change of velocity for a change of impulse. */
  double tangent_scale = 0;
};

/** A row on one joint: a stop, dry friction, or a motor at its torque limit.
 *
 * The impulse p acts along `apply` (+1 or -1) on the joint and stays in lower..upper; strictly
 * inside, measure * v + softness * p + bias = 0 for the joint's velocity v. */
struct JointRow {
  // As ContactCandidate's.
  JointRow();

  /** The solver's chain of degrees of freedom; the row acts on the first ones, and has entries of
   * L^-T J^T for these. */
  int chain = -1;
  int num_pairs = 0;
  const EntryPair* entries = nullptr;
  /** J M^-1 J^T of the joint. */
  double diagonal = 0;
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
  /** J M^-1 J^T + softness, its inverse, and `measure` times that. */
  double scale = 0;
  double inverse = 0;
  double gain = 0;
};

/** Finds the impulses of all contacts and joint rows by projected Gauss-Seidel iterations, starting
 * from the last step's solution; where these converge slowly, with a ChainNewton step for the
 * contacts of each chain after some of them.
 *
 * One iteration solves row after row (block after block) for its own impulse with all others fixed,
 * and projects it onto its bounds: sequential impulses (E. Catto, Iterative Dynamics with Temporal
 * Coherence, GDC 2005; M. Anitescu and F. Potra, 1997, for the time-stepping problem). The softness
 * on the diagonal regularizes redundant contacts and makes the solution unique.
 *
 * The unknown is z = L u, the generalized velocity u scaled by the mass matrix's factor: an impulse
 * p of a row with entries y = L^-T J^T changes z by y p, and J u = y . z, so that no row needs
 * M^-1. The caller gets u = L^-1 z. Memory is allocated once, in reserve().
 *
 * Rows that follow each other and act on the same chain of degrees of freedom, such as the contacts
 * of a foot and the joints of a limb, work on a copy of the chain's part of z, which is contiguous.
 */
class ConstraintSolver {
 public:
  struct Options {
    int max_iterations = 50;
    /** Tolerance, m/s or rad/s: the iteration stops when no row's velocity changes by more. */
    double tolerance = 1e-5;
  };

  /** Allocates memory. @param max_blocks, max_rows, max_chains, max_pairs  Greatest numbers that a
   * step may add.
   * @param max_chain  Most dofs of a chain. */
  void reserve(int max_blocks, int max_rows, int max_chains, int max_chain, int max_pairs);

  /** Removes all constraints. */
  void clear();

  /** Adds a chain of degrees of freedom. @param first_dof  Added to each; the results are indices
   * in the scaled velocity. @return Index, or -1 without memory. */
  int add_chain(const int* dofs, int count, int first_dof);
  /** Memory for entries, or null if it is used up. */
  EntryPair* add_entries(int num_pairs);

  // Constraints are filled in where they stay: a copy right after single values were written would
  // wait for these.

  /** Adds a constraint with the default values. @return null without memory. */
  ContactBlock* begin_block();
  JointRow* begin_row();
  /** Completes the constraint that was added last, or removes it. @return Index. */
  int end_block();
  int end_row();
  void cancel_block() { blocks_.pop_back(); }
  /** A row whose values are to be changed, except its impulse and entries; complete() follows. */
  JointRow& row(int index) { return rows_[index]; }
  static void complete(JointRow& row);

  /** Applies the start values to the scaled velocity. Call once, before solve(); rows added later
   * must start at impulse 0. */
  void warm_start(Eigen::VectorXd& scaled_velocity);
  /** Iterates until converged. @return Number of iterations. */
  int solve(Eigen::VectorXd& scaled_velocity, const Options& options);

  const std::vector<ContactBlock>& blocks() const { return blocks_; }
  const std::vector<JointRow>& rows() const { return rows_; }

 private:
  struct Chain {
    int first = 0;
    int count = 0;
    /** Of its first dofs, so many are the first ones of the step's first chain: those of the root.
     */
    int num_shared = 0;
  };

  int num_pairs_of(int chain) const { return num_pairs(chains_[chain].count); }
  /** Makes local_ the part of z that belongs to a chain. What two chains share stays in it. */
  void enter(int chain, double* z) {
    if (chain != entered_) change_chain(chain, z);
  }
  void change_chain(int chain, double* z);
  /** Writes local_ back to z. */
  void leave(double* z);
  /** A Newton step for all contacts that follow each other and act on the same chain. */
  void step_chains(double* z);
  std::vector<ContactBlock> blocks_;
  std::vector<JointRow> rows_;
  std::vector<Chain> chains_;
  std::vector<int> chain_dofs_;
  std::vector<EntryPair> entries_;
  int num_entries_ = 0;
  std::vector<EntryPair> local_;
  /** Chain that local_ belongs to; -1: none. */
  int entered_ = -1;
  ChainNewton newton_;
};

}  // namespace nao::sim
