#include "sim/stepper.h"

#include <algorithm>
#include <span>

namespace nao::sim {

Stepper::Stepper(const SceneFile& scene, const WorldOptions& options, MovingBodies& bodies)
    : options_(options),
      bodies_(bodies),
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
  scaled_velocity_.setZero(num_dofs);
  const int num_robots = bodies_.num_robots();
  islands_.reserve(num_robots, bodies_.ball.has_value());
  const size_t max_islands = num_robots + (bodies_.ball ? 1 : 0);
  while (steppers_.size() < max_islands) {
    steppers_.push_back(std::make_unique<IslandStepper>(bodies_, options_, detector_));
  }
  size_t max_contacts = 0;
  for (size_t i = 0; i < max_islands; ++i) {
    // As many islands come before this index, each with at least one robot.
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

void Stepper::step() {
  detector_.begin_step(num_steps_);
  const std::span<const Island> islands = islands_.find(detector_);
  const IslandStepper::Step step{num_steps_, stage_probe_, stage_probe_user_};
  const auto step_island = [&](int i) { steppers_[i]->step(islands[i], step, scaled_velocity_); };
  const int count = static_cast<int>(islands.size());
  if (stage_probe_ != nullptr) {
    for (int i = 0; i < count; ++i) step_island(i);
  } else {
    threads_.for_each(count, step_island);
  }
  collect(islands.size());
  ++num_steps_;
}

void Stepper::collect(size_t num_islands) {
  contacts_.clear();
  elastic_energy_ = 0;
  last_iterations_ = 0;
  for (size_t i = 0; i < num_islands; ++i) {
    const std::vector<Contact>& added = steppers_[i]->contacts();
    contacts_.insert(contacts_.end(), added.begin(), added.end());
    elastic_energy_ += steppers_[i]->elastic_energy();
    last_iterations_ = std::max(last_iterations_, steppers_[i]->iterations());
  }
}

}  // namespace nao::sim
