#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "sim/constraint_solver.h"
#include "sim/contact_assembler.h"
#include "sim/contact_candidates.h"
#include "sim/contact_detector.h"
#include "sim/engine.h"
#include "sim/islands.h"
#include "sim/moving_bodies.h"
#include "sim/step_threads.h"
#include "sim/world_options.h"

namespace nao::sim {

/** One time step of the bodies of an island, and the memory for it.
 *
 * Touches no body outside the island: different islands may be stepped at the same time. */
class alignas(StepThreads::kLine) IslandStepper {
 public:
  /** Input of a step besides the island. */
  struct Step {
    int64_t number = 0;
    Engine::StageProbe probe = nullptr;
    void* probe_user = nullptr;
  };

  /** All must outlive this. @param detector  The same one for all islands. */
  IslandStepper(MovingBodies& bodies, const WorldOptions& options, ContactDetector& detector);

  /** Allocates memory. @param max_robots  Greatest number of robots of an island.
   * @param num_dofs  Number of dofs of all bodies.
   * @param max_chain  Most dofs between a root and a body of its robot. */
  void reserve(int max_robots, int num_dofs, int max_chain);

  /** Nothing is allocated. */
  void step(const Island& island, const Step& step);
  /** Forgets the last step and its contacts. */
  void clear();
  void reset_count();
  size_t max_contacts() const { return max_contacts_; }

  /** Number of the last step; -1 if there was none. */
  int64_t last_step() const { return last_step_; }
  /** Results of the last step: contacts with a force; energy in their springs, J; solver
   * iterations.
   */
  const std::vector<Contact>& contacts() const { return assembler_.contacts(); }
  double elastic_energy() const { return assembler_.elastic_energy(); }
  int iterations() const { return iterations_; }
  /** Contacts left out since reset_count(). */
  int64_t num_dropped() const { return candidates_.num_dropped() + num_dropped_blocks_; }

 private:
  void begin_step(const Island& island, const Step& step);
  void add_contacts(size_t first_candidate);
  void solve(const Island& island);
  bool add_missed_constraints(const Island& island);
  void end_step(const Island& island);

  const WorldOptions& options_;
  MovingBodies& bodies_;
  ContactDetector& detector_;
  ContactCandidates candidates_;
  ContactAssembler assembler_;
  ConstraintSolver solver_;
  /** The generalized velocity u of all bodies, of which only the island's elements are used, scaled
   * by the factor of the mass matrix M = L^T L: L u, (num_dofs). */
  Eigen::VectorXd scaled_velocity_;
  int64_t last_step_ = -1;
  size_t max_contacts_ = 0;
  int64_t num_dropped_blocks_ = 0;
  int iterations_ = 0;
};

}  // namespace nao::sim
