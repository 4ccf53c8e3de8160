#include "sim/world.h"

#include <algorithm>
#include <cmath>

#include "common/error.h"

namespace nao::sim {
namespace {

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

/** A contact is made when surfaces will be nearer than this after the step, m. */
constexpr double kMargin = 0.0005;
/** Surfaces farther apart than this cannot meet within a step, m: 15 m/s. */
constexpr double kReach = 0.03;
/** A ball that is slower, m/s, does not bounce. */
constexpr double kLeastBounce = 0.05;
/** Contacts that a robot can have at once: many more than lying takes. */
constexpr int kContactsPerRobot = 96;

/** Unit vectors normal, x-like, y-like, as columns. */
Matrix3d frame_of(const Vector3d& normal) {
  Matrix3d frame;
  frame.col(0) = normal;
  const Vector3d& helper = std::abs(normal.x()) < 0.7 ? Vector3d::UnitX() : Vector3d::UnitY();
  frame.col(1) = (helper - helper.dot(normal) * normal).normalized();
  frame.col(2) = normal.cross(frame.col(1));
  return frame;
}

const Matrix3d kFloorFrame = (Matrix3d() << 0, 1, 0, 0, 0, 1, 1, 0, 0).finished();

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

void World::build_goals() {
  const GoalDimensions& goals = *scene_.goals;
  const double radius = goals.post_diameter / 2;
  const double half_width = goals.post_distance / 2;
  for (const double side : {1.0, -1.0}) {
    const double x = side * (scene_.field->length / 2 + goals.post_offset);
    for (const double y : {half_width, -half_width}) {
      // A capsule whose lower end is in the ground.
      StaticShape post;
      post.shape.center = {x, y, goals.crossbar_height / 2};
      post.shape.half.z() = goals.crossbar_height / 2;
      post.shape.radius = radius;
      statics_.push_back(post);
      StaticShape net;
      net.is_net = true;
      net.shape.radius = 0.01;
      net.shape.center = {x + side * goals.depth / 2, y, goals.crossbar_height / 2};
      net.shape.half = {goals.depth / 2, 0, goals.crossbar_height / 2};
      statics_.push_back(net);
    }
    StaticShape bar;
    bar.shape.center = {x, 0, goals.crossbar_height};
    bar.shape.rotation = Eigen::AngleAxisd(M_PI / 2, Vector3d::UnitX()).toRotationMatrix();
    bar.shape.half.z() = half_width;
    bar.shape.radius = radius;
    statics_.push_back(bar);
    StaticShape back;
    back.is_net = true;
    back.shape.radius = 0.01;
    back.shape.center = {x + side * goals.depth, 0, goals.crossbar_height / 2};
    back.shape.half = {0.001, half_width, goals.crossbar_height / 2};
    statics_.push_back(back);
  }
}

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
  // A motor may have been driven beyond its torque by what happened in the step.
  constexpr int kMaxRounds = 4;
  for (int round = 0; round < kMaxRounds; ++round) {
    bool has_missed = false;
    for (int i = 0; i < num_robots(); ++i) {
      has_missed |= robots_[i]->add_missed_bounds(h, z_, solver_, first_dof_[i]);
    }
    if (!has_missed) break;
    last_sweeps_ += solver_.solve(z_, how);
    for (int i = 0; round == kMaxRounds - 1 && i < num_robots(); ++i) {
      robots_[i]->add_missed_bounds(h, z_, solver_, first_dof_[i]);
    }
  }
  finish_stage(Stage::kSolve);
  end_step();
  ++num_steps_;
  finish_stage(Stage::kIntegrate);
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

void World::place_parts(int index) {
  const SimRobot& robot = *robots_[index];
  const auto& parts = robot.collisions().parts;
  for (size_t i = 0; i < parts.size(); ++i) {
    PlacedPart& placed = placed_[index][i];
    placed.has_rotation = false;
    placed.shape.center = robot.dynamics().position(parts[i].body) +
                          robot.dynamics().rotation(parts[i].body) * parts[i].center_in_body;
  }
}

const RoundedBox& World::part_shape(int robot, int index) {
  PlacedPart& placed = placed_[robot][index];
  if (!placed.has_rotation) {
    const CollisionModel::Part& part = robots_[robot]->collisions().parts[index];
    placed.shape.rotation = robots_[robot]->dynamics().rotation(part.body) * part.rotation_in_body;
    placed.shape.half = part.half;
    placed.shape.radius = part.radius;
    placed.has_rotation = true;
  }
  return placed.shape;
}

void World::find_contacts() {
  for (int i = 0; i < num_robots(); ++i) {
    find_floor_contacts(i);
    find_self_contacts(i);
    if (!statics_.empty()) find_goal_contacts(i);
  }
  for (PairSlots& pair : robot_pairs_) find_robot_contacts(pair);
  if (has_ball()) find_ball_contacts();
}

void World::find_floor_contacts(int index) {
  SimRobot& robot = *robots_[index];
  const CollisionModel& model = robot.collisions();
  for (size_t p = 0; p < model.parts.size(); ++p) {
    const CollisionModel::Part& part = model.parts[p];
    if (placed_[index][p].shape.center.z() > part.bounding_radius + kReach) continue;
    const Vector3d& origin = robot.dynamics().position(part.body);
    const Matrix3d& rotation = robot.dynamics().rotation(part.body);
    for (int i = part.first_point; i < part.end_point; ++i) {
      const CollisionModel::Point& point = model.points[i];
      const Vector3d center = origin + rotation * point.center_in_body;
      Proximity proximity;
      proximity.distance = center.z() - point.radius;
      if (proximity.distance > kReach) continue;
      proximity.point = {center.x(), center.y(), std::min(proximity.distance, 0.0)};
      add_contact({Surface::Kind::kRobot, index, part.link}, part.body, {}, -1, proximity,
                  point.sole, robot.floor_slots_[i]);
    }
  }
}

void World::find_self_contacts(int index) {
  SimRobot& robot = *robots_[index];
  const CollisionModel& model = robot.collisions();
  for (size_t i = 0; i < model.self_pairs.size(); ++i) {
    const auto [a, b] = model.self_pairs[i];
    const CollisionModel::Part& part_a = model.parts[a];
    const CollisionModel::Part& part_b = model.parts[b];
    const double reach = part_a.bounding_radius + part_b.bounding_radius + kMargin;
    const Vector3d offset = placed_[index][a].shape.center - placed_[index][b].shape.center;
    if (offset.squaredNorm() > reach * reach) continue;
    const Proximity proximity = closest_points(part_shape(index, a), part_shape(index, b));
    if (proximity.distance > kReach) continue;
    add_contact({Surface::Kind::kRobot, index, part_a.link}, part_a.body,
                {Surface::Kind::kRobot, index, part_b.link}, part_b.body, proximity, -1,
                robot.self_slots_[i]);
  }
}

void World::find_robot_contacts(PairSlots& pair) {
  constexpr double kRobotReach = 1.4;
  const Vector3d between = robots_[pair.a]->state().position - robots_[pair.b]->state().position;
  if (between.squaredNorm() > kRobotReach * kRobotReach) return;
  const auto& parts_a = robots_[pair.a]->collisions().parts;
  const auto& parts_b = robots_[pair.b]->collisions().parts;
  for (size_t i = 0; i < parts_a.size(); ++i) {
    for (size_t j = 0; j < parts_b.size(); ++j) {
      const double reach = parts_a[i].bounding_radius + parts_b[j].bounding_radius + kMargin;
      const Vector3d offset = placed_[pair.a][i].shape.center - placed_[pair.b][j].shape.center;
      if (offset.squaredNorm() > reach * reach) continue;
      const Proximity proximity = closest_points(part_shape(pair.a, static_cast<int>(i)),
                                                 part_shape(pair.b, static_cast<int>(j)));
      if (proximity.distance > kReach) continue;
      add_contact({Surface::Kind::kRobot, pair.a, parts_a[i].link}, parts_a[i].body,
                  {Surface::Kind::kRobot, pair.b, parts_b[j].link}, parts_b[j].body, proximity, -1,
                  pair.slots[i * parts_b.size() + j]);
    }
  }
}

void World::find_goal_contacts(int index) {
  constexpr double kRobotReach = 0.8;
  const auto& parts = robots_[index]->collisions().parts;
  const Vector3d& center = robots_[index]->state().position;
  for (size_t s = 0; s < statics_.size(); ++s) {
    const RoundedBox& fixed = statics_[s].shape;
    const double far = kRobotReach + fixed.half.norm() + fixed.radius;
    if (statics_[s].is_net || (center - fixed.center).squaredNorm() > far * far) continue;
    for (size_t p = 0; p < parts.size(); ++p) {
      const double reach = parts[p].bounding_radius + fixed.half.norm() + fixed.radius + kMargin;
      if ((placed_[index][p].shape.center - fixed.center).squaredNorm() > reach * reach) continue;
      const Proximity proximity = closest_points(part_shape(index, static_cast<int>(p)), fixed);
      if (proximity.distance > kReach) continue;
      add_contact({Surface::Kind::kRobot, index, parts[p].link}, parts[p].body,
                  {Surface::Kind::kGoal}, -1, proximity, -1,
                  static_slots_[index][s * parts.size() + p]);
    }
  }
}

void World::find_ball_contacts() {
  RoundedBox ball;
  ball.center = ball_.position;
  ball.radius = scene_.ball->radius;
  Proximity on_floor;
  on_floor.distance = ball.center.z() - ball.radius;
  if (on_floor.distance < kReach) {
    on_floor.point = {ball.center.x(), ball.center.y(), std::min(on_floor.distance, 0.0)};
    add_contact({Surface::Kind::kBall}, -1, {}, -1, on_floor, -1, ball_floor_slot_);
  }
  for (size_t s = 0; s < statics_.size(); ++s) {
    const RoundedBox& fixed = statics_[s].shape;
    const double reach = ball.radius + fixed.half.norm() + fixed.radius + kReach;
    if ((ball.center - fixed.center).squaredNorm() > reach * reach) continue;
    const Proximity proximity = closest_points(ball, fixed);
    if (proximity.distance > kReach) continue;
    const Surface surface{statics_[s].is_net ? Surface::Kind::kNet : Surface::Kind::kGoal};
    add_contact({Surface::Kind::kBall}, -1, surface, -1, proximity, -1, ball_static_slots_[s]);
  }
  for (int r = 0; r < num_robots(); ++r) {
    constexpr double kRobotReach = 1;
    if ((robots_[r]->state().position - ball.center).squaredNorm() > kRobotReach * kRobotReach) {
      continue;
    }
    const auto& parts = robots_[r]->collisions().parts;
    for (size_t p = 0; p < parts.size(); ++p) {
      const double reach = ball.radius + parts[p].bounding_radius + kReach;
      if ((ball.center - placed_[r][p].shape.center).squaredNorm() > reach * reach) continue;
      const Proximity proximity = closest_points(ball, part_shape(r, static_cast<int>(p)));
      if (proximity.distance > kReach) continue;
      add_contact({Surface::Kind::kBall}, -1, {Surface::Kind::kRobot, r, parts[p].link},
                  parts[p].body, proximity, -1, ball_robot_slots_[r][p]);
    }
  }
}

Vector3d World::velocity_of(const Surface& surface, int body, const Vector3d& point) const {
  switch (surface.kind) {
    case Surface::Kind::kRobot:
      return robots_[surface.robot]->dynamics().velocity_at(body, point);
    case Surface::Kind::kBall:
      return ball_.velocity + ball_.angular_velocity.cross(point - ball_.position);
    default:
      return Vector3d::Zero();
  }
}

double World::friction_of(const Surface& a, const Surface& b) const {
  const Materials& materials = options_.materials;
  if (a.kind == Surface::Kind::kBall) return materials.ball_friction;
  if (b.kind != Surface::Kind::kFloor) return materials.robot_friction;
  return materials.floor_friction * robots_[a.robot]->options().friction_scale;
}

void World::add_contact(const Surface& a, int body_a, const Surface& b, int body_b,
                        const Proximity& proximity, int sole, ContactSlot& slot) {
  const Materials& materials = options_.materials;
  const double h = options_.step;
  const Vector3d relative =
      velocity_of(a, body_a, proximity.point) - velocity_of(b, body_b, proximity.point);
  const double approach = -proximity.normal.dot(relative);
  if (proximity.distance - h * std::max(approach, 0.0) > kMargin) return;
  if (touches_.size() == touches_.capacity()) return;

  Touch touch;
  touch.a = a;
  touch.b = b;
  touch.body_a = body_a;
  touch.body_b = body_b;
  touch.sole = sole;
  touch.slot = &slot;
  touch.point = proximity.point;
  touch.distance = proximity.distance;
  touch.frame = b.kind == Surface::Kind::kFloor ? kFloorFrame : frame_of(proximity.normal);
  ContactBlock block;
  block.first_entry = add_contact_entries(touch, block.num_entries);
  if (block.first_entry < 0) return;
  block.friction = friction_of(a, b);

  const double strength = h * materials.contact_stiffness + materials.contact_damping;
  // A net catches the ball.
  const bool bounces = a.kind == Surface::Kind::kBall && b.kind != Surface::Kind::kNet &&
                       approach > kLeastBounce && proximity.distance < h * approach;
  if (bounces) {
    block.bias[0] = -materials.ball_restitution * approach;
  } else if (proximity.distance > 0) {
    block.bias[0] = proximity.distance / h;
    block.normal_softness = 1 / (h * strength);
  } else {
    block.bias[0] = materials.contact_stiffness * proximity.distance / strength;
    block.normal_softness = 1 / (h * strength);
  }

  if (slot.last_step != num_steps_ - 1) slot = ContactSlot();
  slot.last_step = num_steps_;
  const double grip = h * materials.tangent_stiffness + materials.tangent_damping;
  block.tangent_softness = 1 / (h * grip);
  touch.tangent_share = materials.tangent_stiffness / grip;
  for (int k = 1; k < 3; ++k) {
    block.bias[k] = touch.tangent_share * touch.frame.col(k).dot(slot.stretch);
  }
  block.impulse = touch.frame.transpose() * slot.impulse;
  block.impulse[0] = std::max(0.0, block.impulse[0]);
  touch.block = solver_.add_block(block);
  if (touch.block < 0) return;
  touches_.push_back(touch);

  if (a.kind == Surface::Kind::kBall && b.kind == Surface::Kind::kFloor) {
    // Resistance against rolling that slows a solid ball down by the wished deceleration:
    // torque = deceleration * (I + m r^2) / r, as a share of the weight.
    ContactBlock rolling;
    rolling.is_rolling = true;
    rolling.friction = rolling.spinning =
        1.4 * scene_.ball->radius * materials.ball_rolling_deceleration / options_.gravity.norm();
    rolling.num_entries = 3;
    rolling.first_entry = solver_.add_entries(3);
    if (rolling.first_entry < 0) return;
    for (int i = 0; i < 3; ++i) {
      solver_.dof(rolling.first_entry + i) = ball_dof_ + i;
      RowEntry entry;
      for (int k = 0; k < 3; ++k) entry.row[k] = touch.frame(i, k) / std::sqrt(ball_inertia_);
      solver_.entry(rolling.first_entry + i) = entry;
    }
    solver_.add_block(rolling);
  }
}

int World::add_body_entries(const Surface& surface, int body, double sign, const Touch& touch) {
  if (surface.kind == Surface::Kind::kBall) {
    const int first = solver_.add_entries(6);
    if (first < 0) return -1;
    const Vector3d arm = touch.point - ball_.position;
    const double by_inertia = sign / std::sqrt(ball_inertia_);
    const double by_mass = sign / std::sqrt(scene_.ball->mass);
    for (int i = 0; i < 3; ++i) {
      RowEntry angular;
      RowEntry linear;
      for (int k = 0; k < 3; ++k) {
        angular.row[k] = by_inertia * arm.cross(touch.frame.col(k))[i];
        linear.row[k] = by_mass * touch.frame(i, k);
      }
      solver_.dof(first + i) = ball_dof_ + i;
      solver_.dof(first + 3 + i) = ball_dof_ + 3 + i;
      solver_.entry(first + i) = angular;
      solver_.entry(first + 3 + i) = linear;
    }
    return 6;
  }
  const SimRobot& robot = *robots_[surface.robot];
  const std::vector<int>& chain = robot.tree().bodies()[body].chain;
  const int count = static_cast<int>(chain.size());
  const int first = solver_.add_entries(count);
  if (first < 0) return -1;
  for (int k = 0; k < count; ++k) {
    position_[chain[k]] = k;
    solver_.dof(first + k) = first_dof_[surface.robot] + chain[k];
    solver_.entry(first + k) = RowEntry();
  }
  robot.dynamics().add_jacobian(body, touch.point, touch.frame, sign, position_.data(),
                                &solver_.entry(first));
  robot.dynamics().solve_upper(chain.data(), count, position_.data(), &solver_.entry(first));
  return count;
}

int World::add_contact_entries(const Touch& touch, int& count) {
  const int first = solver_.add_entries(0);
  const bool is_self = touch.a.kind == Surface::Kind::kRobot &&
                       touch.b.kind == Surface::Kind::kRobot && touch.a.robot == touch.b.robot;
  if (!is_self) {
    count = add_body_entries(touch.a, touch.body_a, 1, touch);
    if (count < 0) return -1;
    if (touch.b.kind != Surface::Kind::kRobot) return first;
    const int more = add_body_entries(touch.b, touch.body_b, -1, touch);
    count += more;
    return more < 0 ? -1 : first;
  }
  // Both bodies hang on one tree: their chains together.
  const SimRobot& robot = *robots_[touch.a.robot];
  const std::vector<int>& chain_a = robot.tree().bodies()[touch.body_a].chain;
  const std::vector<int>& chain_b = robot.tree().bodies()[touch.body_b].chain;
  union_dofs_.clear();
  std::set_union(chain_a.begin(), chain_a.end(), chain_b.begin(), chain_b.end(),
                 std::back_inserter(union_dofs_));
  count = static_cast<int>(union_dofs_.size());
  if (solver_.add_entries(count) < 0) return -1;
  for (int k = 0; k < count; ++k) {
    position_[union_dofs_[k]] = k;
    solver_.dof(first + k) = first_dof_[touch.a.robot] + union_dofs_[k];
    solver_.entry(first + k) = RowEntry();
  }
  RowEntry* entries = &solver_.entry(first);
  const TreeDynamics& dynamics = robot.dynamics();
  dynamics.add_jacobian(touch.body_a, touch.point, touch.frame, 1, position_.data(), entries);
  dynamics.add_jacobian(touch.body_b, touch.point, touch.frame, -1, position_.data(), entries);
  dynamics.solve_upper(union_dofs_.data(), count, position_.data(), entries);
  return first;
}

void World::end_step() {
  const double h = options_.step;
  contacts_.clear();
  elastic_energy_ = 0;
  for (const Touch& touch : touches_) {
    const ContactBlock& block = solver_.blocks()[touch.block];
    ContactSlot& slot = *touch.slot;
    slot.impulse = touch.frame * block.impulse;
    if (block.impulse[0] > 0 && block.normal_softness > 0) {
      const double velocity = -block.normal_softness * block.impulse[0] - block.bias[0];
      const double depth = std::min(0.0, touch.distance + h * velocity);
      elastic_energy_ += 0.5 * options_.materials.contact_stiffness * depth * depth;
    }
    // The tangential spring follows the surfaces as far as friction lets it: what the solver
    // found it to pull, less its damper.
    if (block.impulse[0] > 0) {
      slot.stretch.setZero();
      for (int k = 1; k < 3; ++k) {
        // impulse = -(velocity + share * stretch) / softness, and the spring moves by h * velocity.
        const double velocity = -block.impulse[k] * block.tangent_softness - block.bias[k];
        const double stretch = block.bias[k] / touch.tangent_share + h * velocity;
        slot.stretch += stretch * touch.frame.col(k);
      }
      const double most =
          block.friction * block.impulse[0] / h / options_.materials.tangent_stiffness;
      const double length = slot.stretch.norm();
      if (length > most) slot.stretch *= most / length;
      elastic_energy_ += 0.5 * options_.materials.tangent_stiffness * slot.stretch.squaredNorm();
    } else {
      slot.stretch.setZero();
    }
    if (block.impulse[0] > 0) {
      const Vector3d force = slot.impulse / h;
      contacts_.push_back({touch.a, touch.b, touch.point, force});
      for (const Surface& surface : {touch.a, touch.b}) {
        if (surface.kind == Surface::Kind::kRobot) robots_[surface.robot]->is_touched_ = true;
      }
      if (touch.sole >= 0)
        robots_[touch.a.robot]->add_foot_load(touch.sole, touch.point, slot.impulse);
    }
  }
  for (auto& robot : robots_) robot->end_step(h, solver_);
  if (has_ball()) {
    ball_.angular_velocity = z_.segment<3>(ball_dof_) / std::sqrt(ball_inertia_);
    ball_.velocity = z_.segment<3>(ball_dof_ + 3) / std::sqrt(scene_.ball->mass);
    ball_.position += h * ball_.velocity;
    const double angle = h * ball_.angular_velocity.norm();
    if (angle > 0) {
      const Quaterniond turn(Eigen::AngleAxisd(angle, ball_.angular_velocity.normalized()));
      ball_.orientation = (turn * ball_.orientation).normalized();
    }
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
