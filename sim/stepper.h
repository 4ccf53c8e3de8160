#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "sim/constraint_solver.h"
#include "sim/contact_assembler.h"
#include "sim/contact_detector.h"
#include "sim/moving_bodies.h"
#include "sim/world_options.h"

namespace nao::sim {

/** One time step of all moving bodies of a world.
 *
 * Semi-implicit Euler: forces and constraints give the velocities at the end of the step, and the
 * positions follow with them. Servos, the motors' torque-speed lines and viscous friction are
 * implicit (on the diagonal of the mass matrix); contacts, joint stops, dry friction and torque
 * limits are constraints that a projected Gauss-Seidel solver meets. See docs/physics.md. */
class Stepper {
 public:
  /** What a step consists of, in this order. */
  enum class Stage { kDynamics, kCollision, kRows, kSolve, kIntegrate };

  /** @param bodies, options  Must outlive this. */
  Stepper(const SceneFile& scene, const WorldOptions& options, MovingBodies& bodies);

  /** Numbers the degrees of freedom and takes memory after a robot was added. */
  void add_robot();
  /** Steps. Nothing is allocated. */
  void step();
  /** Forgets all contacts and counts from 0 again. */
  void reset();

  /** Tells that a body was placed somewhere else. */
  void forget_contacts_of_robot(int robot) { detector_.forget_robot(robot); }
  void forget_contacts_of_ball() { detector_.forget_ball(); }

  int64_t num_steps() const { return num_steps_; }
  const std::vector<Contact>& contacts() const { return assembler_.contacts(); }
  /** What the springs of the contacts store, J. */
  double elastic_energy() const { return assembler_.elastic_energy(); }
  /** Contacts left out since reset() because there were more than memory was taken for. */
  int64_t num_dropped_contacts() const { return detector_.num_dropped() + num_dropped_blocks_; }
  /** Iterations of the constraint solver in the last step. */
  int last_iterations() const { return last_iterations_; }
  /** Calls `probe(stage, user)` after each stage of every step; for measurements. */
  void set_stage_probe(void (*probe)(Stage, void*), void* user) {
    stage_probe_ = probe;
    stage_probe_user_ = user;
  }

 private:
  void reserve();
  void finish_stage(Stage stage) {
    if (stage_probe_ != nullptr) stage_probe_(stage, stage_probe_user_);
  }
  void begin_step();
  void add_contacts(size_t first_candidate);
  void solve();
  bool add_missed_constraints();
  void end_step();

  const WorldOptions& options_;
  MovingBodies& bodies_;
  ContactDetector detector_;
  ContactAssembler assembler_;
  ConstraintSolver solver_;
  /** The generalized velocity u of all bodies, scaled by the factor of the mass matrix M = L^T L:
   * L u, (num_dofs). */
  Eigen::VectorXd scaled_velocity_;
  int64_t num_steps_ = 0;
  int64_t num_dropped_blocks_ = 0;
  int last_iterations_ = 0;
  void (*stage_probe_)(Stage, void*) = nullptr;
  void* stage_probe_user_ = nullptr;
};

}  // namespace nao::sim
