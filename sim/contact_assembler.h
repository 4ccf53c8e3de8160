#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "sim/constraint_solver.h"
#include "sim/contact.h"
#include "sim/moving_bodies.h"
#include "sim/world_options.h"

namespace nao::sim {

/** Coefficient of Coulomb friction between two surfaces. */
double friction_between(const Surface& a, const Surface& b, const MovingBodies& bodies,
                        const Materials& materials);

/** Turns contact candidates into the solver's contact blocks, and the solution into forces.
 *
 * **Contact law.** Normal: a spring and a damper, both implicit. With gap velocity v at the end of
 * the step of length h, distance d at its start, and impulse p >= 0,
 *
 *     p / h = -k (d + h v) - c v   =>   v + p / (h (h k + c)) + k d / (h k + c) = 0,
 *
 * which is a constraint row with softness 1 / (h (h k + c)) and bias k d / (h k + c): a soft
 * constraint, whose CFM 1 / (h k + c) and ERP h k / (h k + c) are those of the Open Dynamics
 * Engine's manual. An open gap (d > 0) has bias d / h: it may close within the step, without a
 * force before. A ball that arrives fast enough rebounds instead (Newton's restitution).
 *
 * Tangential: a spring and damper of the same form in Coulomb's cone. The spring's deflection is
 * kept in the ContactMemory, so that a sticking contact does not creep, and is cut where the spring
 * alone would exceed the cone. Materials holds the constants. */
class ContactAssembler {
 public:
  /** @param bodies  Must outlive this. */
  ContactAssembler(MovingBodies& bodies, const WorldOptions& options);

  /** Allocates memory. @param num_dofs  Number of dofs of all bodies. @param max_chain  Most dofs
   * between a root and a body of its robot. */
  void reserve(int max_contacts, int num_dofs, int max_chain);

  /** Forgets the last step's contacts. */
  void clear();
  /** Starts a step without contacts. */
  void begin_step(int64_t step_number);
  /** Adds a candidate's block, started with the impulse of the last step. The candidate must stay
   * where it is until end_step(). @return false if the solver's memory is used up. */
  bool add(const ContactCandidate& candidate, ConstraintSolver& solver);
  /** Reads the solution: contact memories, contact forces, loads on the robots' feet. */
  void end_step(const ConstraintSolver& solver);

  /** Contacts with a force in the last step, in the order in which they were added. */
  const std::vector<Contact>& contacts() const { return contacts_; }
  /** Energy in the springs of the last step's contacts, J. */
  double elastic_energy() const { return elastic_energy_; }

 private:
  struct ActiveContact {
    // As ContactCandidate's.
    ActiveContact();

    const ContactCandidate* candidate = nullptr;
    /** Normal and tangents in W, as columns. */
    Eigen::Matrix3d frame;
    /** Whether these are those of a level floor. */
    bool is_level = false;
    /** Index of its block in the solver. */
    int block = -1;
    /** Bias velocity per deflection of the tangential spring, 1/s: k / (h k + c). */
    double deflection_to_bias = 0;
  };

  /** Contribution of a robot's body to the rows of all its contacts in a step. */
  struct BodyRows {
    int robot = -1;
    int body = -1;
    /** The solver's chain, -1 if there is none yet. */
    int chain = -1;
    /** See TreeDynamics::calc_body_rows(). */
    std::vector<EntryPair> rows;
  };

  void set_normal_law(const ContactCandidate& candidate, ContactBlock& block) const;
  /** Sets chain and entries of a contact's rows. @return false if the solver's memory is used up.
   */
  bool set_entries(const ActiveContact& contact, ContactBlock& block, ConstraintSolver& solver);
  bool set_entries_of_body(const ActiveContact& contact, ContactBlock& block,
                           ConstraintSolver& solver);
  bool set_entries_of_two(const ActiveContact& contact, ContactBlock& block,
                          ConstraintSolver& solver);
  void append_dofs(const Surface& surface, int body);
  void add_surface_entries(const Surface& surface, int body, double sign,
                           const ActiveContact& contact, int num_pairs, EntryPair* entries);
  BodyRows& rows_of_body(int robot, int body);
  void update_spring(const ActiveContact& contact, const ContactBlock& block);

  MovingBodies& bodies_;
  const WorldOptions& options_;
  int64_t step_number_ = 0;
  std::vector<ActiveContact> active_;
  std::vector<Contact> contacts_;
  double elastic_energy_ = 0;
  /** Rows of the bodies whose contacts were assembled last: a body often touches several others.
   * Chosen: a lying robot's contacts have about that many bodies. */
  std::array<BodyRows, 8> body_rows_;
  /** Of them, the one that was used last, and the one that was computed last. */
  size_t last_used_ = 0;
  size_t last_computed_ = 0;
  /** Workspace for a contact of two bodies that move: their dofs, place of each dof among them, and
   * the rows of one body. */
  std::vector<int> dofs_;
  std::vector<int> place_;
  std::vector<EntryPair> surface_rows_;
};

}  // namespace nao::sim
