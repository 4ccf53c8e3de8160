// What of a World is near what: the shapes of robots, goals and ball, pair by pair.

#include <algorithm>

#include "sim/world.h"

namespace nao::sim {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/** Surfaces farther apart than this cannot meet within a step, m: 15 m/s. */
constexpr double kReach = 0.03;
/** A part that turns fast reaches so many times its radius within a step at most: 300 rad/s. */
constexpr double kMostTurned = 1.6;

}  // namespace

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

bool World::add_missed_floor_contacts(int index) {
  SimRobot& robot = *robots_[index];
  const CollisionModel& model = robot.collisions();
  const double h = options_.step;
  bool has_missed = false;
  for (size_t p = 0; p < model.parts.size(); ++p) {
    const CollisionModel::Part& part = model.parts[p];
    const Vector3d& origin = robot.dynamics().position(part.body);
    const Vector3d& part_center = placed_[index][p].shape.center;
    const double speed = robot.dynamics().velocity_at(part.body, part_center).z();
    if (part_center.z() + h * speed > part.bounding_radius * kMostTurned) continue;
    const Matrix3d& rotation = robot.dynamics().rotation(part.body);
    for (int i = part.first_point; i < part.end_point; ++i) {
      if (robot.floor_slots_[i].last_step == num_steps_) continue;
      const CollisionModel::Point& point = model.points[i];
      const Vector3d center = origin + rotation * point.center_in_body;
      const double distance = center.z() - point.radius;
      const Vector3d touching(center.x(), center.y(), std::min(distance, 0.0));
      const double next = distance + h * robot.dynamics().velocity_at(part.body, touching).z();
      if (next >= -kMargin) continue;
      robot.floor_slots_[i] = ContactSlot();
      add_contact({Surface::Kind::kRobot, index, part.link}, part.body, {}, -1,
                  {distance, Vector3d::UnitZ(), touching}, point.sole, robot.floor_slots_[i]);
      has_missed = true;
    }
  }
  return has_missed;
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

}  // namespace nao::sim
