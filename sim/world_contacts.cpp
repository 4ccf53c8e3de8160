// Contacts of a World as rows for the solver, and what the solver made of them.

#include <algorithm>
#include <cmath>

#include "sim/world.h"

namespace nao::sim {
namespace {

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

/** A ball that is slower, m/s, does not bounce. */
constexpr double kLeastBounce = 0.05;

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

}  // namespace nao::sim
