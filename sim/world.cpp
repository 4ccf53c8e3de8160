#include "sim/world.h"

#include <algorithm>
#include <cmath>

#include "common/error.h"

namespace nao::sim {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

/** Contacts that a robot can have at once: many more than lying takes. */
constexpr int kContactsPerRobot = 96;

}  // namespace

World::World(const SceneFile& scene, const WorldOptions& options)
    : scene_(scene), options_(options) {
  if (!(options.step > 0) || options.steps_per_tick < 1 || options.num_sole_points < 3) {
    throw ConfigError("physics step and steps per tick must be above 0, sole points at least 3");
  }
  if (scene_.goals) build_goals();
  if (has_ball()) {
    const double radius = scene_.ball->radius;
    ball_inertia_ = 0.4 * scene_.ball->mass * radius * radius;
    ball_static_slots_.resize(statics_.size());
    ball_dof_ = 0;
    z_.setZero(6);
  }
  solver_.reserve(2 * 64, 0, 8 * 64);
  touches_.reserve(64);
  contacts_.reserve(64);
  reset();
}

World::~World() = default;

int World::add_robot(std::shared_ptr<const RobotModel> model, const RobotOptions& options) {
  if (options.command_latency_ticks < 0 || options.command_latency_ticks > 10) {
    throw ConfigError("command latency must be 0 to 10 ticks");
  }
  if (!(options.mass_scale > 0) || !(options.torque_scale > 0) || !(options.friction_scale > 0)) {
    throw ConfigError("scales of mass, torque and friction must be above 0");
  }
  const int index = num_robots();
  robots_.push_back(std::make_unique<SimRobot>(std::move(model), options, options_));
  const SimRobot& robot = *robots_.back();
  const size_t num_parts = robot.collisions().parts.size();
  placed_.emplace_back(num_parts);
  for (int other = 0; other < index; ++other) {
    const size_t others = robots_[other]->collisions().parts.size();
    robot_pairs_.push_back({other, index, std::vector<ContactSlot>(others * num_parts)});
  }
  ball_robot_slots_.emplace_back(num_parts);
  static_slots_.emplace_back(num_parts * statics_.size());

  first_dof_.clear();
  int num_dofs = 0;
  size_t max_chain = 0;
  for (const auto& each : robots_) {
    first_dof_.push_back(num_dofs);
    num_dofs += each->tree().num_dofs();
    for (const TreeBody& body : each->tree().bodies()) {
      max_chain = std::max(max_chain, body.chain.size());
    }
  }
  if (has_ball()) {
    ball_dof_ = num_dofs;
    num_dofs += 6;
  }
  z_.setZero(num_dofs);
  position_.assign(num_dofs, -1);
  union_dofs_.reserve(num_dofs);
  const int num_contacts = 64 + kContactsPerRobot * num_robots();
  const int num_entries =
      2 * static_cast<int>(max_chain) * num_contacts + num_dofs * static_cast<int>(max_chain);
  solver_.reserve(2 * num_contacts, 4 * num_dofs, num_entries);
  touches_.reserve(num_contacts);
  contacts_.reserve(num_contacts);
  return index;
}

double World::time() const {
  return static_cast<double>(num_steps_) * options_.step;
}

void World::set_targets(int robot, const MotorTargets& targets) {
  robots_[robot]->targets_.position = targets.position;
  robots_[robot]->targets_.stiffness = targets.stiffness;
}

void World::step_tick() {
  for (auto& robot : robots_) {
    const size_t latency = robot->delayed_targets_.size() - 1;
    robot->delayed_targets_[(robot->num_ticks_ + latency) % (latency + 1)] = robot->targets_;
    robot->begin_tick();
  }
  for (int i = 0; i < options_.steps_per_tick; ++i) step();
  ++tick_;
  check_states();
  const double period = options_.step * options_.steps_per_tick;
  for (auto& robot : robots_) robot->end_tick(period);
}

void World::step() {
  begin_step();
  finish_stage(Stage::kDynamics);
  find_contacts();
  finish_stage(Stage::kCollision);
  const double h = options_.step;
  for (int i = 0; i < num_robots(); ++i) {
    robots_[i]->add_joint_rows(h, solver_, first_dof_[i]);
  }
  finish_stage(Stage::kRows);
  solver_.warm_start(z_);
  const ConstraintSolver::Options how{options_.max_sweeps, options_.tolerance};
  last_sweeps_ = solver_.solve(z_, how);
  // What happens in the step (a push, an impact) may drive a motor beyond its torque, or a body
  // that did not move towards the floor into it.
  constexpr int kMaxRounds = 4;
  for (int round = 0; add_missed_constraints() && round < kMaxRounds; ++round) {
    last_sweeps_ += solver_.solve(z_, how);
  }
  finish_stage(Stage::kSolve);
  end_step();
  ++num_steps_;
  finish_stage(Stage::kIntegrate);
}

bool World::add_missed_constraints() {
  bool has_missed = false;
  for (int i = 0; i < num_robots(); ++i) {
    has_missed |= robots_[i]->add_missed_bounds(options_.step, z_, solver_, first_dof_[i]);
    robots_[i]->take_velocities();
    has_missed |= add_missed_floor_contacts(i);
  }
  return has_missed;
}

void World::begin_step() {
  solver_.clear();
  touches_.clear();
  const Vector3d& gravity = options_.gravity;
  const double h = options_.step;
  for (int i = 0; i < num_robots(); ++i) {
    SimRobot& robot = *robots_[i];
    robot.begin_step(h, z_.segment(first_dof_[i], robot.tree().num_dofs()));
    place_parts(i);
  }
  if (has_ball()) {
    // The ball's mass matrix is diagonal, and so is its factor.
    const double mass = scene_.ball->mass;
    z_.segment<3>(ball_dof_) = std::sqrt(ball_inertia_) * ball_.angular_velocity;
    z_.segment<3>(ball_dof_ + 3) =
        std::sqrt(mass) * (ball_.velocity + h * gravity + ball_impulse_ / mass);
    ball_impulse_.setZero();
  }
}

void World::check_states() {
  for (int i = 0; i < num_robots(); ++i) {
    if (robots_[i]->is_sane()) continue;
    ++num_bad_states_;
    robots_[i]->return_to_start();
  }
  const bool is_ball_sane = ball_.position.allFinite() && ball_.velocity.allFinite() &&
                            ball_.angular_velocity.allFinite() &&
                            ball_.position.cwiseAbs().maxCoeff() < 1000;
  if (has_ball() && !is_ball_sane) {
    ++num_bad_states_;
    ball_ = BallState();
    place_ball({scene_.ball->position.x(), scene_.ball->position.y(), 0}, Vector3d::Zero());
  }
}

void World::reset() {
  tick_ = 0;
  num_steps_ = 0;
  num_bad_states_ = 0;
  elastic_energy_ = 0;
  for (auto& robot : robots_) {
    robot->return_to_start();
    robot->switch_on();
  }
  ball_ = BallState();
  ball_impulse_.setZero();
  ball_floor_slot_ = ContactSlot();
  std::fill(ball_static_slots_.begin(), ball_static_slots_.end(), ContactSlot());
  for (auto* all : {&ball_robot_slots_, &static_slots_}) {
    for (auto& slots : *all) std::fill(slots.begin(), slots.end(), ContactSlot());
  }
  for (PairSlots& pair : robot_pairs_) {
    std::fill(pair.slots.begin(), pair.slots.end(), ContactSlot());
  }
  if (has_ball()) {
    place_ball({scene_.ball->position.x(), scene_.ball->position.y(), 0}, Vector3d::Zero());
  }
}

void World::place_robot(int index, const Posture* posture, const Vector3d& position,
                        const Quaterniond* orientation) {
  SimRobot& robot = *robots_[index];
  std::vector<double> joints(robot.drives_.size());
  for (size_t i = 0; i < joints.size(); ++i) {
    joints[i] =
        posture != nullptr ? posture->position[i] : robot.motor_position_[static_cast<long>(i)];
  }
  robot.place(joints, position,
              orientation != nullptr ? *orientation : robot.resting_orientation(posture));
}

void World::place_ball(const Vector3d& position, const Vector3d& velocity) {
  if (!has_ball()) return;
  ball_.position = position + Vector3d(0, 0, scene_.ball->radius);
  ball_.velocity = velocity;
  ball_.angular_velocity.setZero();
  ball_floor_slot_ = ContactSlot();
}

void World::push(int index, int link, const Vector3d& impulse) {
  SimRobot& robot = *robots_[index];
  const int body = robot.tree().body_of_link(link);
  robot.add_impulse(body, impulse);
}

void World::push_ball(const Vector3d& impulse) {
  ball_impulse_ += impulse;
}

double World::energy() const {
  double sum = elastic_energy_;
  for (const auto& robot : robots_) sum += robot->energy();
  if (has_ball()) {
    const double mass = scene_.ball->mass;
    sum += 0.5 * mass * ball_.velocity.squaredNorm() +
           0.5 * ball_inertia_ * ball_.angular_velocity.squaredNorm() -
           mass * options_.gravity.dot(ball_.position);
  }
  return sum;
}

}  // namespace nao::sim
