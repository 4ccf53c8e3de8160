#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "sim/constraint_solver.h"
#include "sim/contact_assembler.h"
#include "sim/contact_detector.h"
#include "sim/engine.h"
#include "sim/moving_bodies.h"
#include "sim/world_options.h"

namespace nao::sim {

/** The fast engine: our own solver, on the model that Simbody builds.
 *
 * Semi-implicit Euler: forces and constraints give the velocities at the end of the step, and the
 * positions follow with them. Servos, the motors' torque-speed lines and viscous friction are
 * implicit (on the diagonal of the mass matrix); contacts, joint stops, dry friction and torque
 * limits are constraints that a projected Gauss-Seidel solver meets. See docs/physics.md. */
class Stepper : public Engine {
 public:
  /** @param bodies, options  Must outlive this. */
  Stepper(const SceneFile& scene, const WorldOptions& options, MovingBodies& bodies);

  const char* name() const override { return "fast"; }
  /** Numbers the degrees of freedom and takes memory. */
  void add_robot() override;
  bool can_change_robots() const override { return true; }
  void remove_robot(int robot) override;
  /** Nothing is allocated. */
  void step() override;
  void reset() override;

  void forget_contacts_of_robot(int robot) override { detector_.forget_robot(robot); }
  void forget_contacts_of_ball() override { detector_.forget_ball(); }

  int64_t num_steps() const override { return num_steps_; }
  const std::vector<Contact>& contacts() const override { return assembler_.contacts(); }
  double elastic_energy() const override { return assembler_.elastic_energy(); }
  int64_t num_dropped_contacts() const override {
    return detector_.num_dropped() + num_dropped_blocks_;
  }
  int last_iterations() const override { return last_iterations_; }
  void set_stage_probe(StageProbe probe, void* user) override {
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
  StageProbe stage_probe_ = nullptr;
  void* stage_probe_user_ = nullptr;
};

}  // namespace nao::sim
