#include "sim/ball.h"

#include <array>
#include <cmath>

namespace nao::sim {

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

Ball::Ball(const BallDescription& description)
    : description_(description),
      // Moment of inertia of a solid sphere: 2/5 m r^2.
      inertia_(0.4 * description.mass * description.radius * description.radius) {}

double Ball::energy(const Vector3d& gravity) const {
  // Kinetic energy of translation and rotation, and potential energy, J:
  const double mass = description_.mass;
  // m v^2 / 2 + I w^2 / 2 - m g . p
  return 0.5 * mass * state_.velocity.squaredNorm() +
         0.5 * inertia_ * state_.angular_velocity.squaredNorm() -
         mass * gravity.dot(state_.position);
}

bool Ball::is_within_bounds() const {
  // Farther than any field is long: only a failed step brings the ball there.
  constexpr double kMaxDistance = 1000;
  return state_.position.allFinite() && state_.velocity.allFinite() &&
         state_.angular_velocity.allFinite() &&
         state_.position.cwiseAbs().maxCoeff() < kMaxDistance;
}

void Ball::reset() {
  state_ = BallState();
  impulse_.setZero();
  // On the floor's plane z = 0; on a bumpy floor the first contact lifts the ball to its surface.
  place({description_.position.x(), description_.position.y(), 0}, Vector3d::Zero());
}

void Ball::place(const Vector3d& position, const Vector3d& velocity) {
  // `position` is the point on the ground below the ball, in W.
  state_.position = position + Vector3d(0, 0, description_.radius);
  state_.velocity = velocity;
  state_.angular_velocity.setZero();
}

void Ball::begin_step(double h, const Vector3d& gravity, Eigen::VectorXd& scaled_velocity) {
  const double mass = description_.mass;
  // Scaled velocity u = M^(1/2) v: in it the mass matrix is the identity, see ConstraintSolver. A
  // sphere's inertia is I times the identity in every orientation, so that there is no gyroscopic
  // torque. Gravity and pushes act over the step: v + h g + impulse / m.
  scaled_velocity.segment<3>(first_dof_) = std::sqrt(inertia_) * state_.angular_velocity;
  scaled_velocity.segment<3>(first_dof_ + 3) =
      std::sqrt(mass) * (state_.velocity + h * gravity + impulse_ / mass);
  impulse_.setZero();
}

void Ball::calc_contact_rows(const Vector3d& point, const Matrix3d& frame, EntryPair* rows) const {
  // The ball's dofs are angular x, y, z, then linear x, y, z, all about W's axes.
  // Velocity of the contact point along axis k of the frame: n_k . (v + w x arm) = n_k . v + (arm x
  // n_k) . w; in scaled velocities each part is divided by the root of its inertia.
  const Vector3d arm = point - state_.position;
  const double by_inertia = 1 / std::sqrt(inertia_);
  const double by_mass = 1 / std::sqrt(description_.mass);
  for (int k = 0; k < 3; ++k) {
    const Vector3d angular = by_inertia * arm.cross(frame.col(k));
    const Vector3d linear = by_mass * frame.col(k);
    double* row = rows[3 * k].data();
    for (int i = 0; i < 3; ++i) {
      row[i] = angular[i];
      row[3 + i] = linear[i];
    }
  }
}

// Rolling without sliding couples rotation and translation: a torque T at the ball slows it down by
// a = T r / (I + m r^2). For T = arm * N and N = m g that is a = arm * m g r / (I + m r^2), and
// (I + m r^2) / (m r) = 1.4 r for a solid sphere.
double Ball::rolling_arm(double deceleration, double gravity) const {
  return 1.4 * description_.radius * deceleration / gravity;
}

void Ball::add_rolling_resistance(const Matrix3d& frame, double deceleration, double gravity,
                                  ConstraintSolver& solver) const {
  // A block whose entries are the ball's three rotations only: rolling resistance is a torque.
  // Spinning about the normal gets the same arm.
  constexpr std::array<int, 3> kRotations{0, 1, 2};
  const int chain = solver.add_chain(kRotations.data(), 3, first_dof_);
  EntryPair* entries = chain < 0 ? nullptr : solver.add_entries(6);
  ContactBlock* rolling = entries == nullptr ? nullptr : solver.begin_block();
  if (rolling == nullptr) return;
  rolling->is_rolling = true;
  rolling->friction = rolling->spinning = rolling_arm(deceleration, gravity);
  rolling->chain = chain;
  for (int k = 0; k < 3; ++k) {
    const Vector3d row = frame.col(k) / std::sqrt(inertia_);
    entries[2 * k] = {row.x(), row.y()};
    entries[2 * k + 1] = {row.z(), 0};
  }
  rolling->entries = entries;
  solver.end_block();
}

void Ball::end_step(double h, const Eigen::VectorXd& scaled_velocity) {
  // Semi-implicit Euler: the pose moves with the velocity after the step.
  // Back from scaled velocities: divided by the roots of the inertias that begin_step() multiplied
  // by.
  state_.angular_velocity = scaled_velocity.segment<3>(first_dof_) / std::sqrt(inertia_);
  state_.velocity = scaled_velocity.segment<3>(first_dof_ + 3) / std::sqrt(description_.mass);
  state_.position += h * state_.velocity;
  const double angle = h * state_.angular_velocity.norm();
  if (angle > 0) {
    // Exponential map of h w, in W: exact for a constant angular velocity. Normalized against
    // rounding.
    const Quaterniond turn(Eigen::AngleAxisd(angle, state_.angular_velocity.normalized()));
    state_.orientation = (turn * state_.orientation).normalized();
  }
}

}  // namespace nao::sim
