#include "sim/contact_assembler.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace nao::sim {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/** Approach speed below which a ball does not rebound, m/s: some times the speed that gravity gives
 * it in a step of 2 ms, so that a ball comes to rest. Chosen. */
constexpr double kMinReboundSpeed = 0.05;

/** Orthonormal frame of a contact: the normal, and two tangents, as columns. */
Matrix3d frame_of(const Vector3d& normal) {
  Matrix3d frame;
  frame.col(0) = normal;
  // An axis that is not nearly parallel to the normal, projected onto the tangent plane.
  const Vector3d& helper = std::abs(normal.x()) < 0.7 ? Vector3d::UnitX() : Vector3d::UnitY();
  frame.col(1) = (helper - helper.dot(normal) * normal).normalized();
  frame.col(2) = normal.cross(frame.col(1));
  return frame;
}

/** Frame of the floor: z, x, y. */
const Matrix3d kFloorFrame = (Matrix3d() << 0, 1, 0, 0, 0, 1, 1, 0, 0).finished();

}  // namespace

ContactAssembler::ContactAssembler(MovingBodies& bodies, const WorldOptions& options)
    : bodies_(bodies), options_(options) {}

void ContactAssembler::reserve(int max_contacts, int num_dofs) {
  active_.reserve(max_contacts);
  contacts_.reserve(max_contacts);
  position_.assign(num_dofs, -1);
  union_dofs_.reserve(num_dofs);
}

void ContactAssembler::clear() {
  active_.clear();
  contacts_.clear();
  elastic_energy_ = 0;
}

void ContactAssembler::begin_step(int64_t step_number) {
  step_number_ = step_number;
  active_.clear();
}

// Coulomb's coefficient of a pair of surfaces. The ball is always surface a, and its coefficient
// holds against everything; the floor's is scaled by each robot's drawn friction disturbance.
double friction_between(const Surface& a, const Surface& b, const MovingBodies& bodies,
                        const Materials& materials) {
  if (a.kind == Surface::Kind::kBall) return materials.ball_friction;
  if (b.kind != Surface::Kind::kFloor) return materials.robot_friction;
  return materials.floor_friction * bodies.robots[a.robot]->options().friction_scale;
}

void ContactAssembler::set_normal_law(const ContactCandidate& candidate,
                                      ContactBlock& block) const {
  const Materials& materials = options_.materials;
  const double h = options_.step;
  const double distance = candidate.proximity.distance;
  // A spring k and damper b, taken implicitly over a step h: with the distance d + h v after the
  // step, the force is f = -k (d + h v) - b v. With the impulse p = h f that is v + p / (h (h k +
  // b)) + k d / (h k + b) = 0: normal_softness and bias of the row.
  const double strength = h * materials.contact_stiffness + materials.contact_damping;
  // A net has no restitution: it catches the ball.
  const bool rebounds =
      candidate.a.kind == Surface::Kind::kBall && candidate.b.kind != Surface::Kind::kNet &&
      candidate.approach_speed > kMinReboundSpeed && distance < h * candidate.approach_speed;
  if (rebounds) {
    // Newton's restitution law: the ball leaves with restitution times its approach speed. No
    // softness: the row is rigid.
    block.bias[0] = -materials.ball_restitution * candidate.approach_speed;
  } else if (distance > 0) {
    // Still apart: the row allows an approach that closes the gap within this step, v >= -d / h.
    // The spring would pull on the surfaces here, so that only its softness is kept.
    block.bias[0] = distance / h;
    block.normal_softness = 1 / (h * strength);
  } else {
    block.bias[0] = materials.contact_stiffness * distance / strength;
    block.normal_softness = 1 / (h * strength);
  }
}

bool ContactAssembler::add(const ContactCandidate& candidate, ConstraintSolver& solver) {
  const Materials& materials = options_.materials;
  const double h = options_.step;
  ActiveContact contact;
  contact.candidate = &candidate;
  const Vector3d& normal = candidate.proximity.normal;
  // On a level floor all contacts have the same axes, which saves their computation.
  const bool is_level = candidate.b.kind == Surface::Kind::kFloor && normal.z() == 1;
  contact.frame = is_level ? kFloorFrame : frame_of(normal);
  ContactBlock block;
  block.first_entry = solver.add_entries(0);
  block.num_entries = add_entries(contact, solver);
  if (block.num_entries < 0) return false;
  block.friction = friction_between(candidate.a, candidate.b, bodies_, options_.materials);
  set_normal_law(candidate, block);

  // Tangential spring and damper, implicit as the normal one; the spring's deflection is carried
  // from step to step. Without it a standing robot would creep, since velocities alone carry no
  // memory of where a contact stuck.
  ContactMemory& memory = *candidate.memory;
  // A contact that was open in the last step starts from nothing.
  if (memory.last_step != step_number_ - 1) memory = ContactMemory();
  memory.last_step = step_number_;
  const double tangent_strength = h * materials.tangent_stiffness + materials.tangent_damping;
  block.tangent_softness = 1 / (h * tangent_strength);
  contact.deflection_to_bias = materials.tangent_stiffness / tangent_strength;
  for (int k = 1; k < 3; ++k) {
    block.bias[k] = contact.deflection_to_bias * contact.frame.col(k).dot(memory.spring_deflection);
  }
  // Warm start: the last impulse in this step's contact frame; projected, since the normal may have
  // turned.
  block.impulse = contact.frame.transpose() * memory.impulse;
  block.impulse[0] = std::max(0.0, block.impulse[0]);
  contact.block = solver.add_block(block);
  if (contact.block < 0) return false;
  active_.push_back(contact);

  // The solver takes the normal impulse for a rolling block from the block before it.
  if (candidate.a.kind == Surface::Kind::kBall && candidate.b.kind == Surface::Kind::kFloor) {
    bodies_.ball->add_rolling_resistance(contact.frame, materials.ball_rolling_deceleration,
                                         options_.gravity.norm(), solver);
  }
  return true;
}

int ContactAssembler::add_entries(const ActiveContact& contact, ConstraintSolver& solver) {
  const ContactCandidate& candidate = *contact.candidate;
  const bool is_self_contact = candidate.a.kind == Surface::Kind::kRobot &&
                               candidate.b.kind == Surface::Kind::kRobot &&
                               candidate.a.robot == candidate.b.robot;
  // The Jacobian's row of a contact between two trees has entries of both, which do not overlap;
  // within one tree the chains share the root, see add_self_contact_entries().
  if (is_self_contact) return add_self_contact_entries(contact, solver);
  const int count = add_surface_entries(candidate.a, candidate.body_a, 1, contact, solver);
  if (count < 0 || candidate.b.kind != Surface::Kind::kRobot) return count;
  const int more = add_surface_entries(candidate.b, candidate.body_b, -1, contact, solver);
  return more < 0 ? -1 : count + more;
}

int ContactAssembler::add_surface_entries(const Surface& surface, int body, double sign,
                                          const ActiveContact& contact, ConstraintSolver& solver) {
  const Vector3d& point = contact.candidate->proximity.point;
  if (surface.kind == Surface::Kind::kBall) {
    return bodies_.ball->add_contact_entries(sign, point, contact.frame, solver);
  }
  // Entries y = L^-T J^T for the dofs of the chain from the root to the body. Fill-in stays within
  // the chain, as all its ancestors are in it.
  const SimRobot& robot = *bodies_.robots[surface.robot];
  const std::vector<int>& chain = robot.tree().bodies()[body].chain;
  const int count = static_cast<int>(chain.size());
  const int first = solver.add_entries(count);
  if (first < 0) return -1;
  for (int k = 0; k < count; ++k) {
    position_[chain[k]] = k;
    solver.dof(first + k) = robot.first_dof() + chain[k];
    solver.entry(first + k) = RowEntry();
  }
  robot.dynamics().add_jacobian(body, point, contact.frame, sign, position_.data(),
                                &solver.entry(first));
  robot.dynamics().solve_upper(chain.data(), count, position_.data(), &solver.entry(first));
  return count;
}

int ContactAssembler::add_self_contact_entries(const ActiveContact& contact,
                                               ConstraintSolver& solver) {
  // Both bodies belong to one tree: the row has entries for the dofs of either chain.
  const ContactCandidate& candidate = *contact.candidate;
  const SimRobot& robot = *bodies_.robots[candidate.a.robot];
  const std::vector<int>& chain_a = robot.tree().bodies()[candidate.body_a].chain;
  const std::vector<int>& chain_b = robot.tree().bodies()[candidate.body_b].chain;
  union_dofs_.clear();
  std::set_union(chain_a.begin(), chain_a.end(), chain_b.begin(), chain_b.end(),
                 std::back_inserter(union_dofs_));
  const int count = static_cast<int>(union_dofs_.size());
  const int first = solver.add_entries(count);
  if (first < 0) return -1;
  for (int k = 0; k < count; ++k) {
    position_[union_dofs_[k]] = k;
    solver.dof(first + k) = robot.first_dof() + union_dofs_[k];
    solver.entry(first + k) = RowEntry();
  }
  RowEntry* entries = &solver.entry(first);
  const TreeDynamics& dynamics = robot.dynamics();
  const Vector3d& point = candidate.proximity.point;
  dynamics.add_jacobian(candidate.body_a, point, contact.frame, 1, position_.data(), entries);
  dynamics.add_jacobian(candidate.body_b, point, contact.frame, -1, position_.data(), entries);
  dynamics.solve_upper(union_dofs_.data(), count, position_.data(), entries);
  return count;
}

void ContactAssembler::update_spring(const ActiveContact& contact, const ContactBlock& block) {
  const double h = options_.step;
  const double stiffness = options_.materials.tangent_stiffness;
  Vector3d& deflection = contact.candidate->memory->spring_deflection;
  // An open contact forgets its deflection.
  deflection.setZero();
  if (!(block.impulse[0] > 0)) return;
  for (int k = 1; k < 3; ++k) {
    // The row holds: velocity + softness * impulse + bias = 0. The spring's new deflection is the
    // old one, bias / deflection_to_bias, plus h * velocity.
    const double velocity = -block.impulse[k] * block.tangent_softness - block.bias[k];
    const double stretched = block.bias[k] / contact.deflection_to_bias + h * velocity;
    deflection += stretched * contact.frame.col(k);
  }
  // In the plane of the contact, the largest deflection is friction * f_n / k.
  // Where the contact slides, the spring follows: its force stays within Coulomb's cone.
  const double most = block.friction * block.impulse[0] / h / stiffness;
  const double length = deflection.norm();
  if (length > most) deflection *= most / length;
  elastic_energy_ += 0.5 * stiffness * deflection.squaredNorm();
}

void ContactAssembler::end_step(const ConstraintSolver& solver) {
  const double h = options_.step;
  contacts_.clear();
  elastic_energy_ = 0;
  for (const ActiveContact& contact : active_) {
    const ContactCandidate& candidate = *contact.candidate;
    const ContactBlock& block = solver.blocks()[contact.block];
    // Stored in W: the contact frame may be another in the next step.
    ContactMemory& memory = *candidate.memory;
    memory.impulse = contact.frame * block.impulse;
    // Elastic energy k d^2 / 2 of the normal spring, with the velocity from the row's equality.
    if (block.impulse[0] > 0 && block.normal_softness > 0) {
      const double velocity = -block.normal_softness * block.impulse[0] - block.bias[0];
      const double depth = std::min(0.0, candidate.proximity.distance + h * velocity);
      elastic_energy_ += 0.5 * options_.materials.contact_stiffness * depth * depth;
    }
    update_spring(contact, block);
    // Contacts without force are candidates only; they are not published.
    if (!(block.impulse[0] > 0)) continue;
    const Vector3d force = memory.impulse / h;
    contacts_.push_back({candidate.a, candidate.b, candidate.proximity.point, force});
    for (const Surface& surface : {candidate.a, candidate.b}) {
      if (surface.kind == Surface::Kind::kRobot) bodies_.robots[surface.robot]->mark_in_contact();
    }
    if (candidate.foot >= 0) {
      bodies_.robots[candidate.a.robot]->add_foot_load(candidate.foot, candidate.proximity.point,
                                                       memory.impulse);
    }
  }
}

}  // namespace nao::sim
