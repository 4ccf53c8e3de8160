#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "sim/contact_detector.h"
#include "sim/engine.h"
#include "sim/island_stepper.h"
#include "sim/islands.h"
#include "sim/moving_bodies.h"
#include "sim/step_threads.h"
#include "sim/world_options.h"

namespace nao::sim {

/** The fast engine: our own solver, on the model that Simbody builds.
 *
 * Semi-implicit Euler: forces and constraints give the velocities at the end of the step, and the
 * positions follow with them. Servos, the motors' torque-speed lines and viscous friction are
 * implicit (on the diagonal of the mass matrix); contacts, joint stops, dry friction and torque
 * limits are constraints that a projected Gauss-Seidel solver satisfies. See docs/physics.md.
 *
 * A tick has groups of bodies that cannot touch each other's within it; a group is one work item of
 * the threads (WorldOptions::num_threads) for the whole tick. In each step a group's islands are
 * stepped one after the other. No group reads what another one writes, so that the bits do not
 * depend on the number of threads. */
class Stepper : public Engine {
 public:
  /** @param bodies, options  Must outlive this. */
  Stepper(const SceneFile& scene, const WorldOptions& options, MovingBodies& bodies);

  const char* name() const override { return "fast"; }
  /** Numbers the degrees of freedom and allocates memory. */
  void add_robot() override;
  bool can_change_robots() const override { return true; }
  void remove_robot(int robot) override;
  /** Nothing is allocated. */
  void step() override;
  void step_tick() override;
  void reset() override;

  void forget_contacts_of_robot(int robot) override { detector_.forget_robot(robot); }
  void forget_contacts_of_ball() override { detector_.forget_ball(); }

  int64_t num_steps() const override { return num_steps_; }
  const std::vector<Contact>& contacts() const override { return contacts_; }
  double elastic_energy() const override { return elastic_energy_; }
  int64_t num_dropped_contacts() const override;
  int last_iterations() const override { return last_iterations_; }
  /** The stages of all islands, one island after the other, in one thread. */
  void set_stage_probe(StageProbe probe, void* user) override {
    stage_probe_ = probe;
    stage_probe_user_ = user;
  }

 private:
  void reserve();
  void clear_contacts();
  /** Index of the first body, where the ball comes after the robots. */
  int first_body(const Island& island) const;
  /** Calls work(group) for all groups of bodies that cannot touch within a number of steps. */
  template <class Work>
  void for_each_group(int num_steps, Work work);
  void step_group(const Island& group, int64_t step_number);
  /** Combines the results of the islands' last step. */
  void collect();

  ContactDetector detector_;
  Island all_bodies_;
  Islands groups_;
  /** By the group's first body: its division into islands. */
  std::vector<Islands> islands_;
  /** By the island's first body. */
  std::vector<std::unique_ptr<IslandStepper>> steppers_;
  StepThreads threads_;
  std::vector<Contact> contacts_;
  double elastic_energy_ = 0;
  int64_t num_steps_ = 0;
  int last_iterations_ = 0;
  StageProbe stage_probe_ = nullptr;
  void* stage_probe_user_ = nullptr;
};

}  // namespace nao::sim
