#include "sim/contact_detector.h"

#include <algorithm>
#include <limits>

#include "sim/products.h"

namespace nao::sim {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/** Distance of surfaces at the start of a step beyond which they are ignored, m. Chosen for
 * approach speeds up to 15 m/s at steps of 2 ms. Faster impacts of robot points on the floor are
 * found by find_missed_floor_contacts(). */
constexpr double kReach = 0.03;
/** A point of a part that rotates within the step is at most this many bounding radii away from
 * where the part's center will be: 1 + 300 rad/s (the largest rate that a valid state has) times
 * 2 ms. */
constexpr double kMaxSweptRadius = 1.6;
/** Excess of the parts' distance along an axis over their greatest approach, m, for which their
 * distance is not measured. Chosen: far above rounding, so that no contact is missed. */
constexpr double kApartMargin = 1e-6;

/** Distance of two parts' bounding spheres up to which their pair is listed as near, m. Chosen:
 * with 1 cm lists of a walking robot are made more often, with 5 cm they are longer. */
constexpr double kNear = 0.02;
/** Displacement of a part after which the list is made anew, m: two parts come nearer by twice
 * that, which is below kNear by far more than rounding. */
constexpr double kMostMoved = 0.00995;

/** Half the extent of a shape along a unit axis, m. */
double half_extent(const RoundedBox& shape, const Vector3d& axis) {
  return (shape.rotation.transpose() * axis).cwiseAbs().dot(shape.half) + shape.radius;
}

template <class Memories>
void forget(Memories& memories) {
  std::fill(memories.begin(), memories.end(), ContactMemory());
}

}  // namespace

[[gnu::always_inline]] inline double ContactDetector::greatest_turn(const TreeDynamics& dynamics,
                                                                    int body) const {
  // The 1-norm needs no root.
  return step_ * dynamics.angular_velocity(body).lpNorm<1>();
}

[[gnu::always_inline]] inline double ContactDetector::greatest_move(const TreeDynamics& dynamics,
                                                                    int body, const Vector3d& point,
                                                                    double radius) const {
  return step_ * dynamics.velocity_at(body, point).lpNorm<1>() +
         radius * greatest_turn(dynamics, body);
}

ContactCandidate::ContactCandidate() = default;

ContactDetector::ContactDetector(const SceneFile& scene, const MovingBodies& bodies,
                                 const Floor& floor, double step)
    : bodies_(bodies), floor_(floor), step_(step), statics_(make_goal_shapes(scene)) {
  // One memory for each possible contact, at a fixed place: impulses and friction springs are found
  // again in the next step without a search.
  if (scene.ball) ball_static_memory_.resize(statics_.size());
}

void ContactDetector::add_robot() {
  const int index = bodies_.num_robots() - 1;
  const CollisionModel& model = bodies_.robots[index]->collisions();
  const size_t num_parts = model.parts.size();
  placed_.emplace_back(num_parts);
  RobotMemory memory;
  memory.floor.resize(model.points.size());
  memory.floor_distance.resize(model.points.size());
  memory.nearest_free.resize(num_parts);
  memory.self.resize(model.self_pairs.size());
  memory.near_pairs.reserve(model.self_pairs.size());
  memory.listed_centers.reserve(num_parts);
  for (const auto& [a, b] : model.self_pairs) {
    const double reach = model.parts[a].bounding_radius + model.parts[b].bounding_radius + kMargin;
    memory.self_reach.push_back(reach);
  }
  memory.statics.resize(num_parts * statics_.size());
  memory.ball.resize(num_parts);
  robot_memory_.push_back(std::move(memory));
  // Every pair of robots has a table of (part of the first) x (part of the second).
  for (int other = 0; other < index; ++other) {
    const size_t other_parts = bodies_.robots[other]->collisions().parts.size();
    pair_memory_.push_back({other, index, std::vector<ContactMemory>(other_parts * num_parts)});
  }
}

void ContactDetector::remove_robot(int robot) {
  placed_.erase(placed_.begin() + robot);
  robot_memory_.erase(robot_memory_.begin() + robot);
  std::erase_if(pair_memory_,
                [robot](const PairMemory& pair) { return pair.a == robot || pair.b == robot; });
  for (PairMemory& pair : pair_memory_) {
    if (pair.a > robot) --pair.a;
    if (pair.b > robot) --pair.b;
  }
}

// This is needed after a robot was placed elsewhere: its old impulses would push it at the new
// place.
void ContactDetector::forget_robot(int robot) {
  RobotMemory& memory = robot_memory_[robot];
  for (auto* memories : {&memory.floor, &memory.self, &memory.statics, &memory.ball}) {
    forget(*memories);
  }
  for (PairMemory& pair : pair_memory_) {
    if (pair.a == robot || pair.b == robot) forget(pair.parts);
  }
}

void ContactDetector::forget_ball() {
  ball_floor_memory_ = ContactMemory();
  forget(ball_static_memory_);
  for (RobotMemory& memory : robot_memory_) forget(memory.ball);
}

void ContactDetector::clear() {
  for (size_t robot = 0; robot < robot_memory_.size(); ++robot) {
    forget_robot(static_cast<int>(robot));
  }
  forget_ball();
}

void ContactDetector::place_parts(int index) {
  const SimRobot& robot = *bodies_.robots[index];
  const auto& parts = robot.collisions().parts;
  for (size_t i = 0; i < parts.size(); ++i) {
    PlacedPart& placed = placed_[index][i];
    placed.has_rotation = false;
    // Part's center in W. The rotation is computed by part_shape() only where a narrow phase needs
    // it.
    placed.shape.center = robot.dynamics().point_in_world(parts[i].body, parts[i].center_in_body);
  }
}

const RoundedBox& ContactDetector::part_shape(int robot, int index) {
  PlacedPart& placed = placed_[robot][index];
  if (!placed.has_rotation) {
    const CollisionModel::Part& part = bodies_.robots[robot]->collisions().parts[index];
    placed.shape.rotation =
        product(bodies_.robots[robot]->dynamics().rotation(part.body), part.rotation_in_body);
    placed.shape.half = part.half;
    placed.shape.radius = part.radius;
    placed.has_rotation = true;
  }
  return placed.shape;
}

bool ContactDetector::are_apart(int robot_a, int index_a, int robot_b, int index_b,
                                const ContactMemory& memory) {
  const Vector3d& axis = memory.separating_axis;
  const RoundedBox& a = part_shape(robot_a, index_a);
  const RoundedBox& b = part_shape(robot_b, index_b);
  // A lower bound of the distance; negative where there is no axis yet.
  const double separation =
      axis.dot(a.center - b.center) - half_extent(a, axis) - half_extent(b, axis);
  if (!(separation > kMargin + kApartMargin)) return false;
  // Upper bound of the approach speed at the point of contact, which is in the middle between the
  // surfaces: at most half of kReach away from part a.
  const CollisionModel::Part& part_a = bodies_.robots[robot_a]->collisions().parts[index_a];
  const CollisionModel::Part& part_b = bodies_.robots[robot_b]->collisions().parts[index_b];
  const TreeDynamics& dynamics_a = bodies_.robots[robot_a]->dynamics();
  const TreeDynamics& dynamics_b = bodies_.robots[robot_b]->dynamics();
  const Vector3d moving =
      dynamics_a.velocity_at(part_a.body, a.center) - dynamics_b.velocity_at(part_b.body, a.center);
  const Vector3d turning =
      dynamics_a.angular_velocity(part_a.body) - dynamics_b.angular_velocity(part_b.body);
  const double speed = moving.norm() + turning.norm() * (part_a.bounding_radius + kReach / 2);
  return separation > kMargin + kApartMargin + step_ * speed;
}

bool ContactDetector::are_near(int a, int b, int num_steps) const {
  // No part of a robot is farther from its root than reach: one test for all pairs of parts.
  const SimRobot& robot_a = *bodies_.robots[a];
  const SimRobot& robot_b = *bodies_.robots[b];
  const double far = robot_a.collisions().reach + robot_b.collisions().reach + num_steps * kReach;
  return (robot_a.state().position - robot_b.state().position).squaredNorm() <= far * far;
}

bool ContactDetector::is_near_ball(int index, int num_steps) const {
  const SimRobot& robot = *bodies_.robots[index];
  const double far = robot.collisions().reach + bodies_.ball->radius() + num_steps * kReach;
  return (robot.state().position - bodies_.ball->state().position).squaredNorm() <= far * far;
}

void ContactDetector::find(const Island& island, ContactCandidates& found) {
  // Order: floor, self, goals, pairs of robots, ball. The order decides in which sequence the
  // solver visits contacts, and so the last digits: it must depend on the state only.
  for (const int robot : island.robots) place_parts(robot);
  for (const int robot : island.robots) {
    find_floor_contacts(robot, found);
    find_self_contacts(robot, found);
    if (!statics_.empty()) find_goal_contacts(robot, found);
  }
  for (const int b : island.robots) {
    for (const int a : island.robots) {
      if (a >= b) break;
      find_robot_contacts(pair_memory_[b * (b - 1) / 2 + a], found);
    }
  }
  if (island.has_ball) find_ball_contacts(island, found);
}

[[gnu::always_inline]] inline Vector3d ContactDetector::velocity_of(const Surface& surface,
                                                                    int body,
                                                                    const Vector3d& point) const {
  // Velocity in W, m/s, of the surface's material point at `point`; the floor and goals do not
  // move.
  switch (surface.kind) {
    case Surface::Kind::kRobot:
      return bodies_.robots[surface.robot]->dynamics().velocity_at(body, point);
    case Surface::Kind::kBall:
      return bodies_.ball->velocity_at(point);
    default:
      return Vector3d::Zero();
  }
}

// Inlined, so that the vectors stay in registers.
[[gnu::always_inline]] inline bool ContactDetector::add(const Surface& a, int body_a,
                                                        const Surface& b, int body_b,
                                                        const Proximity& proximity, int foot,
                                                        ContactMemory& memory,
                                                        ContactCandidates& found) const {
  const Vector3d relative =
      velocity_of(a, body_a, proximity.point) - velocity_of(b, body_b, proximity.point);
  const double approach_speed = -proximity.normal.dot(relative);
  // Distance after the step if nothing stops the surfaces. A separating velocity is not used: an
  // impulse of the step may reverse it.
  // The distance is predicted to first order: d + h d'. Surfaces that may touch within the step
  // become constraints now, so that they cannot pass through each other before the next detection.
  if (proximity.distance - step_ * std::max(approach_speed, 0.0) > kMargin) return false;
  ContactCandidate* candidate = found.add();
  if (candidate == nullptr) {
    // It is marked, so that it is counted once in a step.
    memory = ContactMemory();
    memory.last_step = found.step_number();
    return true;
  }
  candidate->a = a;
  candidate->b = b;
  candidate->body_a = body_a;
  candidate->body_b = body_b;
  candidate->foot = foot;
  candidate->proximity = proximity;
  candidate->approach_speed = approach_speed;
  candidate->memory = &memory;
  return true;
}

// Distance of a sphere (a corner point with its radius) from the floor, and the point of contact in
// W: on the sphere's surface when it penetrates, on the floor otherwise.
[[gnu::always_inline]] inline Proximity ContactDetector::to_floor(const Vector3d& center,
                                                                  double radius) const {
  Proximity proximity;
  if (floor_.is_flat()) {
    proximity.distance = center.z() - radius;
    proximity.point = {center.x(), center.y(), std::min(proximity.distance, 0.0)};
    return proximity;
  }
  // The plane of the triangle below the center: bumps are far flatter than they are wide.
  const Floor::Plane plane = floor_.at(center.x(), center.y());
  proximity.normal = plane.normal;
  // Distance of the center from the plane through (x, y, height): the vertical distance times the
  // normal's vertical component.
  proximity.distance = plane.normal.z() * (center.z() - plane.height) - radius;
  proximity.point = center - (radius + std::max(proximity.distance, 0.0)) * plane.normal;
  return proximity;
}

// On a level floor, a loop without branches over plain arrays: two points at a time.
void ContactDetector::measure_floor_distances(int index, const CollisionModel::Part& part) {
  const TreeDynamics& dynamics = bodies_.robots[index]->dynamics();
  const CollisionModel& model = bodies_.robots[index]->collisions();
  double* distance = robot_memory_[index].floor_distance.data();
  if (!floor_.is_flat()) {
    for (int i = part.first_point; i < part.end_point; ++i) {
      const CollisionModel::Point& point = model.points[i];
      const Vector3d center = dynamics.point_in_world(part.body, point.center_in_body);
      distance[i] = to_floor(center, point.radius).distance;
    }
    return;
  }
  const double* x = model.point_x.data();
  const double* y = model.point_y.data();
  const double* z = model.point_z.data();
  const double* radius = model.point_radius.data();
  const Vector3d up = dynamics.rotation(part.body).row(2);
  const double height = dynamics.position(part.body).z();
  const double rx = up.x();
  const double ry = up.y();
  const double rz = up.z();
  for (int i = part.first_point; i < part.end_point; ++i) {
    // As point_in_world().
    distance[i] = height + (rx * x[i] + ry * y[i] + rz * z[i]) - radius[i];
  }
}

void ContactDetector::find_floor_contacts(int index, ContactCandidates& found) {
  const SimRobot& robot = *bodies_.robots[index];
  const CollisionModel& model = robot.collisions();
  RobotMemory& memory = robot_memory_[index];
  for (size_t p = 0; p < model.parts.size(); ++p) {
    const CollisionModel::Part& part = model.parts[p];
    const Vector3d& part_center = placed_[index][p].shape.center;
    memory.nearest_free[p] = -std::numeric_limits<double>::infinity();
    // Bounding sphere over the highest bump: most parts of a standing robot end here.
    const double height = part_center.z() - floor_.max_height();
    if (height > part.bounding_radius + kReach) continue;
    measure_floor_distances(index, part);
    // The floor's point below a point of the part is at most kReach farther from its center.
    const double reach = std::min(
        kReach,
        kMargin + kApartMargin +
            greatest_move(robot.dynamics(), part.body, part_center, part.bounding_radius + kReach));
    double nearest = std::numeric_limits<double>::infinity();
    for (int i = part.first_point; i < part.end_point; ++i) {
      if (memory.floor_distance[i] <= reach) {
        const CollisionModel::Point& point = model.points[i];
        const Vector3d center = robot.dynamics().point_in_world(part.body, point.center_in_body);
        if (add({Surface::Kind::kRobot, index, part.link}, part.body, {}, -1,
                to_floor(center, point.radius), point.sole, memory.floor[i], found)) {
          continue;
        }
      }
      nearest = std::min(nearest, memory.floor_distance[i]);
    }
    memory.nearest_free[p] = nearest;
  }
}

// After a solution of the step: points that are above the floor now but would be below it after the
// step, since an impulse within the step (a push, an impact elsewhere) has changed their velocity.
// They become candidates too. Returns whether there are any.
bool ContactDetector::find_missed_floor_contacts(int index, ContactCandidates& found) {
  const SimRobot& robot = *bodies_.robots[index];
  const CollisionModel& model = robot.collisions();
  RobotMemory& memories = robot_memory_[index];
  bool has_missed = false;
  for (size_t p = 0; p < model.parts.size(); ++p) {
    const CollisionModel::Part& part = model.parts[p];
    const Vector3d& part_center = placed_[index][p].shape.center;
    // Vertical speed of the part's center only; kMaxSweptRadius covers the rotation.
    const double speed = robot.dynamics().velocity_at(part.body, part_center).z();
    const double height = part_center.z() - floor_.max_height();
    if (height + step_ * speed > part.bounding_radius * kMaxSweptRadius) continue;
    // A point at a distance d moves as one that is bounding radius + d away from the part's center:
    // above this d it cannot reach the floor within the step.
    const double turn = greatest_turn(robot.dynamics(), part.body);
    const double moved =
        greatest_move(robot.dynamics(), part.body, part_center, part.bounding_radius);
    const double safe_distance =
        turn < 1 ? moved / (1 - turn) : std::numeric_limits<double>::infinity();
    if (memories.nearest_free[p] > safe_distance) continue;
    for (int i = part.first_point; i < part.end_point; ++i) {
      ContactMemory& memory = memories.floor[i];
      if (memory.last_step == found.step_number()) continue;  // A constraint of this step already.
      const CollisionModel::Point& point = model.points[i];
      const Vector3d center = robot.dynamics().point_in_world(part.body, point.center_in_body);
      const Proximity proximity = to_floor(center, point.radius);
      if (proximity.distance > safe_distance) continue;
      const Vector3d velocity = robot.dynamics().velocity_at(part.body, proximity.point);
      // Distance after the step with the velocity of the present solution.
      const double next = proximity.distance + step_ * proximity.normal.dot(velocity);
      if (next >= -kMargin) continue;
      // It had no force in the last step.
      memory = ContactMemory();
      add({Surface::Kind::kRobot, index, part.link}, part.body, {}, -1, proximity, point.sole,
          memory, found);
      has_missed = true;
    }
  }
  return has_missed;
}

// Most of a robot's pairs stay apart for many steps. The list has every pair whose spheres can
// touch now, in the order of all pairs, so that what is found does not depend on when it was made.
const std::vector<size_t>& ContactDetector::list_near_pairs(int index) {
  const CollisionModel& model = bodies_.robots[index]->collisions();
  const Vector3d& root = bodies_.robots[index]->state().position;
  const std::vector<PlacedPart>& placed = placed_[index];
  RobotMemory& memory = robot_memory_[index];
  double moved = 0;  // m^2
  for (size_t i = 0; i < memory.listed_centers.size(); ++i) {
    moved =
        std::max(moved, (placed[i].shape.center - root - memory.listed_centers[i]).squaredNorm());
  }
  if (!memory.listed_centers.empty() && moved < kMostMoved * kMostMoved) return memory.near_pairs;
  memory.listed_centers.clear();
  for (const PlacedPart& part : placed) memory.listed_centers.push_back(part.shape.center - root);
  memory.near_pairs.clear();
  for (size_t i = 0; i < model.self_pairs.size(); ++i) {
    const auto [a, b] = model.self_pairs[i];
    const double reach = memory.self_reach[i] + kNear;
    const Vector3d offset = placed[a].shape.center - placed[b].shape.center;
    if (offset.squaredNorm() > reach * reach) continue;
    memory.near_pairs.push_back(i);
  }
  return memory.near_pairs;
}

void ContactDetector::find_self_contacts(int index, ContactCandidates& found) {
  const CollisionModel& model = bodies_.robots[index]->collisions();
  const PlacedPart* placed = placed_[index].data();
  RobotMemory& memories = robot_memory_[index];
  for (const size_t i : list_near_pairs(index)) {
    const auto [a, b] = model.self_pairs[i];
    // The spheres are a lower bound of the distance: |offset| - r_a - r_b <= distance.
    // Broad phase: bounding spheres that are apart have no closest points to look for.
    const Vector3d offset = placed[a].shape.center - placed[b].shape.center;
    if (offset.squaredNorm() > memories.self_reach[i] * memories.self_reach[i]) continue;
    ContactMemory& memory = memories.self[i];
    if (are_apart(index, a, index, b, memory)) continue;
    // Narrow phase: GJK on the rounded boxes, see robot_model/closest_points.h.
    const Proximity proximity = closest_points(part_shape(index, a), part_shape(index, b));
    memory.separating_axis = proximity.normal;
    if (proximity.distance > kReach) continue;
    const CollisionModel::Part& part_a = model.parts[a];
    const CollisionModel::Part& part_b = model.parts[b];
    add({Surface::Kind::kRobot, index, part_a.link}, part_a.body,
        {Surface::Kind::kRobot, index, part_b.link}, part_b.body, proximity, -1, memory, found);
  }
}

void ContactDetector::find_robot_contacts(PairMemory& pair, ContactCandidates& found) {
  const SimRobot& robot_a = *bodies_.robots[pair.a];
  const SimRobot& robot_b = *bodies_.robots[pair.b];
  if (!are_near(pair.a, pair.b, 1)) return;
  const auto& parts_a = robot_a.collisions().parts;
  const auto& parts_b = robot_b.collisions().parts;
  for (size_t i = 0; i < parts_a.size(); ++i) {
    for (size_t j = 0; j < parts_b.size(); ++j) {
      const double reach = parts_a[i].bounding_radius + parts_b[j].bounding_radius + kMargin;
      const Vector3d offset = placed_[pair.a][i].shape.center - placed_[pair.b][j].shape.center;
      if (offset.squaredNorm() > reach * reach) continue;
      const int a = static_cast<int>(i);
      const int b = static_cast<int>(j);
      ContactMemory& memory = pair.parts[i * parts_b.size() + j];
      if (are_apart(pair.a, a, pair.b, b, memory)) continue;
      const Proximity proximity = closest_points(part_shape(pair.a, a), part_shape(pair.b, b));
      memory.separating_axis = proximity.normal;
      if (proximity.distance > kReach) continue;
      add({Surface::Kind::kRobot, pair.a, parts_a[i].link}, parts_a[i].body,
          {Surface::Kind::kRobot, pair.b, parts_b[j].link}, parts_b[j].body, proximity, -1, memory,
          found);
    }
  }
}

void ContactDetector::find_goal_contacts(int index, ContactCandidates& found) {
  const CollisionModel& model = bodies_.robots[index]->collisions();
  const auto& parts = model.parts;
  const Vector3d& center = bodies_.robots[index]->state().position;
  for (size_t s = 0; s < statics_.size(); ++s) {
    const RoundedBox& fixed = statics_[s].shape;
    const double far = model.reach + kReach + fixed.half.norm() + fixed.radius;
    // Nets stop only the ball.
    if (statics_[s].is_net || (center - fixed.center).squaredNorm() > far * far) continue;
    for (size_t p = 0; p < parts.size(); ++p) {
      const double reach = parts[p].bounding_radius + fixed.half.norm() + fixed.radius + kMargin;
      if ((placed_[index][p].shape.center - fixed.center).squaredNorm() > reach * reach) continue;
      const Proximity proximity = closest_points(part_shape(index, static_cast<int>(p)), fixed);
      if (proximity.distance > kReach) continue;
      add({Surface::Kind::kRobot, index, parts[p].link}, parts[p].body, {Surface::Kind::kGoal}, -1,
          proximity, -1, robot_memory_[index].statics[s * parts.size() + p], found);
    }
  }
}

void ContactDetector::find_ball_contacts(const Island& island, ContactCandidates& found) {
  // A sphere is a rounded box with half lengths of 0.
  RoundedBox ball;
  ball.center = bodies_.ball->state().position;
  ball.radius = bodies_.ball->radius();
  const Proximity on_floor = to_floor(ball.center, ball.radius);
  if (on_floor.distance < kReach) {
    add({Surface::Kind::kBall}, -1, {}, -1, on_floor, -1, ball_floor_memory_, found);
  }
  for (size_t s = 0; s < statics_.size(); ++s) {
    const RoundedBox& fixed = statics_[s].shape;
    const double reach = ball.radius + fixed.half.norm() + fixed.radius + kReach;
    if ((ball.center - fixed.center).squaredNorm() > reach * reach) continue;
    const Proximity proximity = closest_points(ball, fixed);
    if (proximity.distance > kReach) continue;
    const Surface surface{statics_[s].is_net ? Surface::Kind::kNet : Surface::Kind::kGoal};
    add({Surface::Kind::kBall}, -1, surface, -1, proximity, -1, ball_static_memory_[s], found);
  }
  for (const int r : island.robots) {
    if (!is_near_ball(r, 1)) continue;
    const auto& parts = bodies_.robots[r]->collisions().parts;
    for (size_t p = 0; p < parts.size(); ++p) {
      const double reach = ball.radius + parts[p].bounding_radius + kReach;
      if ((ball.center - placed_[r][p].shape.center).squaredNorm() > reach * reach) continue;
      const Proximity proximity = closest_points(ball, part_shape(r, static_cast<int>(p)));
      if (proximity.distance > kReach) continue;
      add({Surface::Kind::kBall}, -1, {Surface::Kind::kRobot, r, parts[p].link}, parts[p].body,
          proximity, -1, robot_memory_[r].ball[p], found);
    }
  }
}

}  // namespace nao::sim
