#include "sim/stepper.h"

#include <algorithm>
#include <numeric>
#include <span>

namespace nao::sim {

Stepper::Stepper(const SceneFile& scene, const WorldOptions& options, MovingBodies& bodies)
    : Engine(options, bodies),
      detector_(scene, bodies, Floor(options.floor), options.step),
      threads_(options.num_threads) {
  reserve();
}

void Stepper::add_robot() {
  detector_.add_robot();
  reserve();
}

void Stepper::remove_robot(int robot) {
  detector_.remove_robot(robot);
  // The contacts of the last step name robots by index.
  clear_contacts();
  reserve();
}

// Gives each robot and the ball its range of dofs in the common vector of scaled velocities, and
// allocates memory for the greatest number of constraints. A step allocates nothing.
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
  const int num_robots = bodies_.num_robots();
  all_bodies_.robots.resize(num_robots);
  std::iota(all_bodies_.robots.begin(), all_bodies_.robots.end(), 0);
  all_bodies_.has_ball = bodies_.ball.has_value();
  groups_.reserve(num_robots, all_bodies_.has_ball);
  const size_t max_islands = num_robots + (bodies_.ball ? 1 : 0);
  islands_.resize(max_islands);
  for (Islands& islands : islands_) islands.reserve(num_robots, all_bodies_.has_ball);
  while (steppers_.size() < max_islands) {
    steppers_.push_back(std::make_unique<IslandStepper>(bodies_, options_, detector_));
  }
  size_t max_contacts = 0;
  for (size_t i = 0; i < max_islands; ++i) {
    // No robot of the island comes before its first one.
    steppers_[i]->reserve(num_robots - static_cast<int>(i), num_dofs, static_cast<int>(max_chain));
    max_contacts += steppers_[i]->max_contacts();
  }
  contacts_.reserve(max_contacts);
}

void Stepper::clear_contacts() {
  contacts_.clear();
  elastic_energy_ = 0;
  for (const auto& stepper : steppers_) stepper->clear();
}

void Stepper::reset() {
  num_steps_ = 0;
  for (const auto& stepper : steppers_) stepper->reset_count();
  detector_.clear();
  clear_contacts();
}

int64_t Stepper::num_dropped_contacts() const {
  int64_t sum = 0;
  for (const auto& stepper : steppers_) sum += stepper->num_dropped();
  return sum;
}

int Stepper::first_body(const Island& island) const {
  return island.robots.empty() ? bodies_.num_robots() : island.robots.front();
}

template <class Work>
void Stepper::for_each_group(int num_steps, Work work) {
  const std::span<const Island> groups = groups_.find(all_bodies_, num_steps, detector_);
  // The ball alone is not worth a thread.
  if (stage_probe_ != nullptr || groups.size() < 2 || groups[1].robots.empty()) {
    for (const Island& group : groups) work(group);
  } else {
    threads_.for_each(static_cast<int>(groups.size()), [&](int i) { work(groups[i]); });
  }
  num_steps_ += num_steps;
  collect();
}

void Stepper::step_group(const Island& group, int64_t step_number) {
  for (const int robot : group.robots) bodies_.robots[robot]->apply_drag(options_.step);
  const IslandStepper::Step step{step_number, stage_probe_, stage_probe_user_};
  for (const Island& island : islands_[first_body(group)].find(group, 1, detector_)) {
    steppers_[first_body(island)]->step(island, step);
  }
}

void Stepper::step() {
  for_each_group(1, [this](const Island& group) { step_group(group, num_steps_); });
}

void Stepper::step_tick() {
  for_each_group(options_.steps_per_tick, [this](const Island& group) {
    for (const int robot : group.robots) bodies_.robots[robot]->begin_tick();
    for (int i = 0; i < options_.steps_per_tick; ++i) step_group(group, num_steps_ + i);
    for (const int robot : group.robots) end_tick(robot);
  });
}

void Stepper::collect() {
  contacts_.clear();
  elastic_energy_ = 0;
  last_iterations_ = 0;
  for (const auto& stepper : steppers_) {
    if (stepper->last_step() != num_steps_ - 1) continue;
    const std::vector<Contact>& added = stepper->contacts();
    contacts_.insert(contacts_.end(), added.begin(), added.end());
    elastic_energy_ += stepper->elastic_energy();
    last_iterations_ = std::max(last_iterations_, stepper->iterations());
  }
}

}  // namespace nao::sim
