#include "sim/stepper.h"

#include <algorithm>

namespace nao::sim {
namespace {

/** Contacts that memory is taken for. Chosen: a standing NAO has 16, a lying one about 11
 * (nao-bench-physics); the contacts of ball and goals share the first number. */
constexpr int kContactsPerWorld = 64;
constexpr int kContactsPerRobot = 96;
/** Rows of one joint at most: stop, dry friction, upper and lower torque bound. */
constexpr int kRowsPerJoint = 4;
/** Entries of a ball's contact with the floor: 6, and 3 for rolling resistance. */
constexpr int kEntriesPerBallContact = 9;
/** Times that constraints are added to a solved step at most. Chosen: one is usual in an impact. */
constexpr int kMaxRounds = 4;

}  // namespace

Stepper::Stepper(const SceneFile& scene, const WorldOptions& options, MovingBodies& bodies)
    : options_(options),
      bodies_(bodies),
      detector_(scene, bodies, Floor(options.floor), options.step),
      assembler_(bodies, options) {
  reserve();
}

void Stepper::add_robot() {
  detector_.add_robot();
  reserve();
}

void Stepper::remove_robot(int robot) {
  detector_.remove_robot(robot);
  // Its contacts of the last step name robots by index.
  assembler_.clear();
  reserve();
}

// Gives each robot and the ball its range of dofs in the common vector of scaled velocities, and
// takes memory for the most constraints. A step allocates nothing.
void Stepper::reserve() {
  int num_dofs = 0;
  size_t max_chain = 0;
  for (const auto& robot : bodies_.robots) {
    robot->set_first_dof(num_dofs);
    num_dofs += robot->tree().num_dofs();
    for (const TreeBody& body : robot->tree().bodies()) {
      max_chain = std::max(max_chain, body.chain.size());
    }
  }
  if (bodies_.ball) {
    bodies_.ball->set_first_dof(num_dofs);
    num_dofs += 6;
  }
  scaled_velocity_.setZero(num_dofs);
  const int num_contacts = kContactsPerWorld + kContactsPerRobot * bodies_.num_robots();
  const int entries_per_contact = std::max(2 * static_cast<int>(max_chain), kEntriesPerBallContact);
  // A contact has a block, the ball's with the floor two. All rows of a joint share their entries.
  solver_.reserve(2 * num_contacts, kRowsPerJoint * num_dofs,
                  entries_per_contact * num_contacts + num_dofs * static_cast<int>(max_chain));
  detector_.reserve(num_contacts);
  assembler_.reserve(num_contacts, num_dofs);
}

void Stepper::reset() {
  num_steps_ = 0;
  num_dropped_blocks_ = 0;
  detector_.clear();
  assembler_.clear();
}

// One step of the fast engine: (1) velocities with all smooth forces, (2) contact candidates, (3)
// constraint rows, (4) impulses by projected Gauss-Seidel, (5) new positions.
void Stepper::step() {
  begin_step();
  finish_stage(Stage::kDynamics);
  detector_.find(num_steps_);
  finish_stage(Stage::kCollision);
  add_contacts(0);
  for (const auto& robot : bodies_.robots) robot->add_joint_rows(options_.step, solver_);
  finish_stage(Stage::kRows);
  solve();
  finish_stage(Stage::kSolve);
  end_step();
  ++num_steps_;
  finish_stage(Stage::kIntegrate);
}

void Stepper::begin_step() {
  solver_.clear();
  assembler_.begin_step(num_steps_);
  for (const auto& robot : bodies_.robots) {
    robot->begin_step(options_.step,
                      scaled_velocity_.segment(robot->first_dof(), robot->tree().num_dofs()));
  }
  if (bodies_.ball) bodies_.ball->begin_step(options_.step, options_.gravity, scaled_velocity_);
}

void Stepper::add_contacts(size_t first_candidate) {
  const std::vector<ContactCandidate>& candidates = detector_.candidates();
  for (size_t i = first_candidate; i < candidates.size(); ++i) {
    // Full memory leaves the contact out; the daemon warns of it.
    if (!assembler_.add(candidates[i], solver_)) ++num_dropped_blocks_;
  }
}

void Stepper::solve() {
  solver_.warm_start(scaled_velocity_);
  const ConstraintSolver::Options how{options_.max_iterations, options_.tolerance};
  last_iterations_ = solver_.solve(scaled_velocity_, how);
  // Impulses that act within the step (a push, an impact elsewhere) may drive a motor beyond its
  // torque, or into the floor a point that did not move towards it before. Such constraints are
  // added, and the solution goes on from where it is.
  for (int round = 0; add_missed_constraints() && round < kMaxRounds; ++round) {
    last_iterations_ += solver_.solve(scaled_velocity_, how);
  }
}

bool Stepper::add_missed_constraints() {
  // Every robot is checked although one already has missed constraints: one further solution then
  // covers all of them.
  bool has_missed = false;
  for (int i = 0; i < bodies_.num_robots(); ++i) {
    SimRobot& robot = *bodies_.robots[i];
    has_missed |= robot.add_missed_bounds(options_.step, scaled_velocity_, solver_);
    // find_missed_floor_contacts() reads velocities of the solution, not of the step's start.
    robot.take_velocities();
    const size_t num_candidates = detector_.candidates().size();
    has_missed |= detector_.find_missed_floor_contacts(i);
    add_contacts(num_candidates);
  }
  return has_missed;
}

// The assembler first: it tells robots which of their feet carry load, and whether they are in
// contact.
void Stepper::end_step() {
  assembler_.end_step(solver_);
  for (const auto& robot : bodies_.robots) robot->end_step(options_.step, solver_);
  if (bodies_.ball) bodies_.ball->end_step(options_.step, scaled_velocity_);
}

}  // namespace nao::sim
