#include "sim/island_stepper.h"

#include <algorithm>

namespace nao::sim {
namespace {

/** Number of contacts for which memory is allocated. Chosen: a standing NAO has 16, a lying one
 * about 11 (nao-bench-physics); the contacts of ball and goals share the first number. */
constexpr int kContactsPerWorld = 64;
constexpr int kContactsPerRobot = 96;
/** Rows of one joint at most: stop, dry friction, upper and lower torque bound. */
constexpr int kRowsPerJoint = 4;
/** Degrees of freedom of a ball. */
constexpr int kDofsOfBall = 6;
/** Greatest number of times that constraints are added to a solved step. Chosen: one is usual in an
 * impact. */
constexpr int kMaxRounds = 4;

}  // namespace

IslandStepper::IslandStepper(MovingBodies& bodies, const WorldOptions& options,
                             ContactDetector& detector)
    : options_(options), bodies_(bodies), detector_(detector), assembler_(bodies, options) {}

void IslandStepper::reserve(int max_robots, int num_dofs, int max_chain) {
  const int num_contacts = kContactsPerWorld + kContactsPerRobot * max_robots;
  // Two bodies touch each other. A contact has a block, the ball's with the floor two.
  const int most_dofs = 2 * std::max(max_chain, kDofsOfBall);
  solver_.reserve(2 * num_contacts, kRowsPerJoint * num_dofs, 2 * num_contacts + num_dofs,
                  most_dofs, 3 * num_pairs(most_dofs) * num_contacts);
  candidates_.reserve(num_contacts);
  max_contacts_ = num_contacts;
  assembler_.reserve(num_contacts, num_dofs, max_chain);
  scaled_velocity_.setZero(num_dofs);
}

void IslandStepper::clear() {
  last_step_ = -1;
  assembler_.clear();
}

void IslandStepper::reset_count() {
  num_dropped_blocks_ = 0;
  candidates_.reset_count();
}

// One step of the fast engine: (1) velocities with all smooth forces, (2) contact candidates, (3)
// constraint rows, (4) impulses by projected Gauss-Seidel, (5) new positions.
void IslandStepper::step(const Island& island, const Step& step) {
  const auto finish = [&step](Engine::Stage stage) {
    if (step.probe != nullptr) step.probe(stage, step.probe_user);
  };
  begin_step(island, step);
  finish(Engine::Stage::kDynamics);
  detector_.find(island, candidates_);
  finish(Engine::Stage::kCollision);
  add_contacts(0);
  for (const int robot : island.robots) {
    bodies_.robots[robot]->add_joint_rows(options_.step, solver_);
  }
  finish(Engine::Stage::kRows);
  solve(island);
  finish(Engine::Stage::kSolve);
  end_step(island);
  finish(Engine::Stage::kIntegrate);
}

void IslandStepper::begin_step(const Island& island, const Step& step) {
  last_step_ = step.number;
  candidates_.begin_step(step.number);
  solver_.clear();
  assembler_.begin_step(step.number);
  for (const int index : island.robots) {
    SimRobot& robot = *bodies_.robots[index];
    robot.begin_step(options_.step,
                     scaled_velocity_.segment(robot.first_dof(), robot.tree().num_dofs()));
  }
  if (island.has_ball) {
    bodies_.ball->begin_step(options_.step, options_.gravity, scaled_velocity_);
  }
}

void IslandStepper::add_contacts(size_t first_candidate) {
  const std::vector<ContactCandidate>& candidates = candidates_.list();
  for (size_t i = first_candidate; i < candidates.size(); ++i) {
    // Full memory leaves the contact out; the daemon warns of it.
    if (!assembler_.add(candidates[i], solver_)) ++num_dropped_blocks_;
  }
}

void IslandStepper::solve(const Island& island) {
  solver_.warm_start(scaled_velocity_);
  const ConstraintSolver::Options how{options_.max_iterations, options_.tolerance};
  iterations_ = solver_.solve(scaled_velocity_, how);
  // Impulses that act within the step (a push, an impact elsewhere) may drive a motor beyond its
  // torque, or into the floor a point that did not move towards it before. Such constraints are
  // added, and the iterations continue from the present solution.
  for (int round = 0; add_missed_constraints(island) && round < kMaxRounds; ++round) {
    iterations_ += solver_.solve(scaled_velocity_, how);
  }
}

bool IslandStepper::add_missed_constraints(const Island& island) {
  // Every robot is checked although one already has missed constraints: one further solution then
  // covers all of them.
  bool has_missed = false;
  for (const int index : island.robots) {
    SimRobot& robot = *bodies_.robots[index];
    has_missed |= robot.add_missed_bounds(options_.step, scaled_velocity_, solver_);
    // find_missed_floor_contacts() reads velocities of the solution, not of the step's start.
    robot.take_velocities();
    const size_t num_candidates = candidates_.list().size();
    has_missed |= detector_.find_missed_floor_contacts(index, candidates_);
    add_contacts(num_candidates);
  }
  return has_missed;
}

// The assembler comes first: it tells robots which of their feet carry load, and whether they are
// in contact.
void IslandStepper::end_step(const Island& island) {
  assembler_.end_step(solver_);
  for (const int robot : island.robots) bodies_.robots[robot]->end_step(options_.step, solver_);
  if (island.has_ball) bodies_.ball->end_step(options_.step, scaled_velocity_);
}

}  // namespace nao::sim
