#include "sim/contact_assembler.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace nao::sim {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/** Approach speed below which a ball does not rebound, m/s: several times the speed that gravity
 * gives it in a step of 2 ms, so that a ball comes to rest. Chosen. */
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

ContactAssembler::ActiveContact::ActiveContact() = default;

ContactAssembler::ContactAssembler(MovingBodies& bodies, const WorldOptions& options)
    : bodies_(bodies), options_(options) {}

void ContactAssembler::reserve(int max_contacts, int num_dofs, int max_chain) {
  active_.reserve(max_contacts);
  contacts_.reserve(max_contacts);
  // A ball has 6 dofs; it may be alone in the world.
  const int most = num_pairs(std::max(max_chain, 6));
  for (BodyRows& body : body_rows_) body.rows.resize(6 * most);
  surface_rows_.resize(3 * most);
  dofs_.reserve(4 * most);
  place_.assign(num_dofs, -1);
}

void ContactAssembler::clear() {
  active_.clear();
  contacts_.clear();
  elastic_energy_ = 0;
}

void ContactAssembler::begin_step(int64_t step_number) {
  step_number_ = step_number;
  active_.clear();
  for (BodyRows& body : body_rows_) body.robot = -1;
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
    // The surfaces are still apart: the row allows an approach that closes the gap within this
    // step, v >= -d / h. The spring would pull on them here, so that only its softness is kept.
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
  ContactBlock* new_block = solver.begin_block();
  if (new_block == nullptr) return false;
  ContactBlock& block = *new_block;
  ActiveContact& contact = active_.emplace_back();
  contact.candidate = &candidate;
  const Vector3d& normal = candidate.proximity.normal;
  // On a level floor all contacts have the same axes, which saves their computation.
  const bool is_level = candidate.b.kind == Surface::Kind::kFloor && normal.z() == 1;
  contact.is_level = is_level;
  contact.frame = is_level ? kFloorFrame : frame_of(normal);
  if (!set_entries(contact, block, solver)) {
    solver.cancel_block();
    active_.pop_back();
    return false;
  }
  block.friction = friction_between(candidate.a, candidate.b, bodies_, options_.materials);
  set_normal_law(candidate, block);

  // Tangential spring and damper, implicit as the normal one; the spring's deflection is carried
  // from step to step. Without it a standing robot would creep, since velocities alone carry no
  // memory of where a contact stuck.
  ContactMemory& memory = *candidate.memory;
  // A contact that was open in the last step starts without impulse and deflection.
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
  contact.block = solver.end_block();

  // The solver takes the normal impulse for a rolling block from the block before it.
  if (candidate.a.kind == Surface::Kind::kBall && candidate.b.kind == Surface::Kind::kFloor) {
    bodies_.ball->add_rolling_resistance(contact.frame, materials.ball_rolling_deceleration,
                                         options_.gravity.norm(), solver);
  }
  return true;
}

bool ContactAssembler::set_entries(const ActiveContact& contact, ContactBlock& block,
                                   ConstraintSolver& solver) {
  const ContactCandidate& candidate = *contact.candidate;
  const bool is_of_one_body =
      candidate.a.kind == Surface::Kind::kRobot && candidate.b.kind != Surface::Kind::kRobot;
  return is_of_one_body ? set_entries_of_body(contact, block, solver)
                        : set_entries_of_two(contact, block, solver);
}

ContactAssembler::BodyRows& ContactAssembler::rows_of_body(int robot, int body) {
  const auto is_it = [&](const BodyRows& rows) { return rows.robot == robot && rows.body == body; };
  // Contacts of a body with the floor follow each other.
  if (is_it(body_rows_[last_used_])) return body_rows_[last_used_];
  const auto known = std::find_if(body_rows_.begin(), body_rows_.end(), is_it);
  if (known != body_rows_.end()) {
    last_used_ = known - body_rows_.begin();
    return *known;
  }
  last_used_ = last_computed_ = (last_computed_ + 1) % body_rows_.size();
  BodyRows& rows = body_rows_[last_used_];
  rows.robot = robot;
  rows.body = body;
  rows.chain = -1;
  bodies_.robots[robot]->dynamics().calc_body_rows(body, rows.rows.data());
  return rows;
}

namespace {

/** Rows of the velocity of a body's point along the axes of a frame. @param rows  Rows of the
 * body's spatial velocity. @param is_level  Whether the frame is kFloorFrame. @param arm  Vector
 * from the rows' reference point to the point, m. */
void calc_point_rows(const EntryPair* rows, int count, const Vector3d& arm, const Matrix3d& frame,
                     bool is_level, EntryPair* result) {
  for (int i = 0; i < count; ++i) {
    const EntryPair wx = rows[i];
    const EntryPair wy = rows[count + i];
    const EntryPair wz = rows[2 * count + i];
    // v + w x arm
    const EntryPair x = rows[3 * count + i] + wy * arm.z() - wz * arm.y();
    const EntryPair y = rows[4 * count + i] + wz * arm.x() - wx * arm.z();
    const EntryPair z = rows[5 * count + i] + wx * arm.y() - wy * arm.x();
    if (is_level) {
      result[i] = z;
      result[count + i] = x;
      result[2 * count + i] = y;
      continue;
    }
    for (int k = 0; k < 3; ++k) {
      result[k * count + i] = frame(0, k) * x + frame(1, k) * y + frame(2, k) * z;
    }
  }
}

}  // namespace

bool ContactAssembler::set_entries_of_body(const ActiveContact& contact, ContactBlock& block,
                                           ConstraintSolver& solver) {
  const ContactCandidate& candidate = *contact.candidate;
  const SimRobot& robot = *bodies_.robots[candidate.a.robot];
  const std::vector<int>& dofs = robot.tree().bodies()[candidate.body_a].chain;
  const int count = num_pairs(static_cast<int>(dofs.size()));
  BodyRows& body = rows_of_body(candidate.a.robot, candidate.body_a);
  if (body.chain < 0)
    body.chain = solver.add_chain(dofs.data(), static_cast<int>(dofs.size()), robot.first_dof());
  EntryPair* entries = body.chain < 0 ? nullptr : solver.add_entries(3 * count);
  if (entries == nullptr) return false;
  calc_point_rows(body.rows.data(), count, candidate.proximity.point - robot.dynamics().origin(),
                  contact.frame, contact.is_level, entries);
  block.chain = body.chain;
  block.entries = entries;
  return true;
}

// Two bodies of one robot share a part of their chains, which both contribute to; or one body is
// the ball, and the other one belongs to a robot or does not move.
bool ContactAssembler::set_entries_of_two(const ActiveContact& contact, ContactBlock& block,
                                          ConstraintSolver& solver) {
  const ContactCandidate& candidate = *contact.candidate;
  dofs_.clear();
  append_dofs(candidate.a, candidate.body_a);
  append_dofs(candidate.b, candidate.body_b);
  std::sort(dofs_.begin(), dofs_.end());
  dofs_.erase(std::unique(dofs_.begin(), dofs_.end()), dofs_.end());
  for (size_t i = 0; i < dofs_.size(); ++i) place_[dofs_[i]] = static_cast<int>(i);
  const int count = num_pairs(static_cast<int>(dofs_.size()));
  const int chain = solver.add_chain(dofs_.data(), static_cast<int>(dofs_.size()), 0);
  EntryPair* entries = chain < 0 ? nullptr : solver.add_entries(3 * count);
  if (entries == nullptr) return false;
  std::fill(entries, entries + 3 * count, EntryPair::Zero());
  add_surface_entries(candidate.a, candidate.body_a, 1, contact, count, entries);
  add_surface_entries(candidate.b, candidate.body_b, -1, contact, count, entries);
  block.chain = chain;
  block.entries = entries;
  return true;
}

void ContactAssembler::append_dofs(const Surface& surface, int body) {
  if (surface.kind == Surface::Kind::kBall) {
    for (int i = 0; i < 6; ++i) dofs_.push_back(bodies_.ball->first_dof() + i);
  }
  if (surface.kind != Surface::Kind::kRobot) return;
  const SimRobot& robot = *bodies_.robots[surface.robot];
  for (const int dof : robot.tree().bodies()[body].chain) dofs_.push_back(robot.first_dof() + dof);
}

void ContactAssembler::add_surface_entries(const Surface& surface, int body, double sign,
                                           const ActiveContact& contact, int count,
                                           EntryPair* entries) {
  const Vector3d& point = contact.candidate->proximity.point;
  const auto add = [&](const auto& dofs, int first_dof) {
    const int num_dofs = static_cast<int>(dofs.size());
    for (int k = 0; k < 3; ++k) {
      const double* from = surface_rows_[k * num_pairs(num_dofs)].data();
      double* to = entries[k * count].data();
      for (int i = 0; i < num_dofs; ++i) to[place_[first_dof + dofs[i]]] += sign * from[i];
    }
  };
  if (surface.kind == Surface::Kind::kBall) {
    bodies_.ball->calc_contact_rows(point, contact.frame, surface_rows_.data());
    add(std::array<int, 6>{0, 1, 2, 3, 4, 5}, bodies_.ball->first_dof());
  }
  if (surface.kind != Surface::Kind::kRobot) return;
  const SimRobot& robot = *bodies_.robots[surface.robot];
  const std::vector<int>& dofs = robot.tree().bodies()[body].chain;
  calc_point_rows(rows_of_body(surface.robot, body).rows.data(),
                  num_pairs(static_cast<int>(dofs.size())), point - robot.dynamics().origin(),
                  contact.frame, contact.is_level, surface_rows_.data());
  add(dofs, robot.first_dof());
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
    // Contacts without force are only candidates and are not published.
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
