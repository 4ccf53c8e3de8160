#include "sim/tree_integrator.h"

#include <algorithm>
#include <cmath>

namespace nao::sim {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

// Bounds of a valid state. The wildest motion of shake_test stays below 250 rad/s; speeds and
// distances are chosen far beyond anything that a robot reaches.
/** rad/s. */
constexpr double kMaxRate = 300;
/** m/s. */
constexpr double kMaxSpeed = 100;
/** Distance from the origin, and below the floor, m (a lying torso is above 0). */
constexpr double kMaxDistance = 1000;
constexpr double kMaxDepth = 0.2;

/** Quaternion of a rotation vector: the exponential map. */
Quaterniond exponential(const Vector3d& rotation, double angle) {
  // sin(x / 2) / x, for small x by its series, which is exact to rounding below 1e-4.
  const double half = angle / 2;
  const double scale = angle < 1e-4 ? 0.5 - angle * angle / 48 : std::sin(half) / angle;
  const Vector3d v = scale * rotation;
  return Quaterniond(std::cos(half), v.x(), v.y(), v.z());
}

}  // namespace

TreeIntegrator::TreeIntegrator(const Tree& tree, bool is_root_fixed, const Vector3d& gravity)
    : tree_(tree),
      is_root_fixed_(is_root_fixed),
      gravity_(gravity),
      state_(tree.num_dofs()),
      dynamics_(tree, is_root_fixed) {
  for (Eigen::VectorXd* vector : {&external_impulse_, &bias_, &diagonal_, &momentum_, &work_}) {
    *vector = Eigen::VectorXd::Zero(tree.num_dofs());
  }
}

void TreeIntegrator::place(const Eigen::VectorXd& coordinate, const Vector3d& position,
                           const Quaterniond& orientation) {
  state_.velocity.setZero();
  state_.coordinate = coordinate;
  state_.orientation = orientation.normalized();
  root_change_ = {};
  external_impulse_.setZero();
  move_root(position);
}

void TreeIntegrator::move_root(const Vector3d& position) {
  state_.position = position;
  dynamics_.update_kinematics(state_);
}

// A push at the center of mass of a body; several in one step add up.
void TreeIntegrator::add_impulse(int body, const Vector3d& impulse) {
  add_impulse_at(body, dynamics_.body_center_of_mass(body), impulse);
}

void TreeIntegrator::add_impulse_at(int body, const Vector3d& point, const Vector3d& impulse) {
  // J^T times the impulse, J the Jacobian of the point.
  external_impulse_.head<3>() += (point - dynamics_.origin()).cross(impulse);
  external_impulse_.segment<3>(3) += impulse;
  const Vector3d moment = (point - dynamics_.origin()).cross(impulse);
  for (int i = body; i > 0; i = tree_.bodies()[i].parent) {
    const SpatialVector& motion = dynamics_.motion(i);
    external_impulse_[tree_.bodies()[i].dof] +=
        motion.angular.dot(moment) + motion.linear.dot(impulse);
  }
}

// Engines that integrate by themselves apply the pushes as forces.
Eigen::VectorXd TreeIntegrator::take_impulses() {
  Eigen::VectorXd impulses = external_impulse_;
  external_impulse_.setZero();
  return impulses;
}

void TreeIntegrator::set_state(const TreeState& state) {
  state_ = state;
  dynamics_.update_kinematics(state_);
  dynamics_.update_mass_matrix();
}

void TreeIntegrator::begin_step(double h) {
  dynamics_.update_mass_matrix();
  dynamics_.calc_bias(gravity_, bias_);
  work_ = state_.velocity;
  if (!is_root_fixed_) {
    // The effect of Coriolis forces on the root's own motion is contained in integrate(), which
    // carries the momentum over to the new configuration. It is taken back here, so that it does
    // not count twice; their effect on the joints stays.
    const Vector3d weight = tree_.total_mass() * gravity_;
    const Vector3d arm = dynamics_.center_of_mass_from_origin();
    // Root motion that the bias forces (without weight) would cause if the joints were held: rigid
    // body with the composite inertia.
    const SpatialVector back =
        dynamics_.rigid_motion({bias_.head<3>() + arm.cross(weight), bias_.segment<3>(3) + weight});
    work_.head<3>() += h * back.angular;
    work_.segment<3>(3) += h * back.linear;
  }
  dynamics_.multiply_by_mass(work_, momentum_);
  // M u + impulses - h c: momentum after the step's smooth forces, except the joints' (added by
  // JointDrives).
  momentum_ += external_impulse_ - h * bias_;
  // The root's rows of M are the unit matrix on a stand: zero momentum keeps it at rest.
  if (is_root_fixed_) momentum_.head<6>().setZero();
  diagonal_.setZero();
  external_impulse_.setZero();
}

const Eigen::VectorXd& TreeIntegrator::factorize() {
  // L^T L u' = momentum: half of the solution here; contacts act on z = L u', and velocity_of()
  // does the other half.
  dynamics_.factorize(diagonal_);
  dynamics_.solve_upper(momentum_);
  return momentum_;
}

void TreeIntegrator::take_velocity() {
  state_.velocity = work_;
  dynamics_.update_velocities(state_);
}

void TreeIntegrator::integrate(double h, bool is_in_contact) {
  // Momentum that the forces of the step have given: linear, and angular about the center of mass.
  // About the center of mass, where it is constant in free flight; O moves with the root.
  SpatialVector momentum;
  if (!is_root_fixed_) {
    momentum = dynamics_.momentum_at(state_.velocity);
    momentum.angular -= dynamics_.center_of_mass_from_origin().cross(momentum.linear);
  }

  const auto num_joint_dofs = state_.velocity.size() - 6;
  // Semi-implicit Euler: positions move with the velocities after the step.
  state_.coordinate.tail(num_joint_dofs) += h * state_.velocity.tail(num_joint_dofs);

  // Without contact the root moves with the velocity that belongs to the momentum in the
  // configuration half a step later: half of the change that set_momentum() will make below, which
  // is about that of the last step. With contact forces, that could add energy.
  if (is_in_contact) root_change_ = {};
  state_.position += h * (state_.velocity.segment<3>(3) + root_change_.linear / 2);
  const Vector3d rotation = h * (state_.velocity.head<3>() + root_change_.angular / 2);
  const double angle = rotation.norm();
  if (angle > 0) {
    state_.orientation = exponential(rotation, angle) * state_.orientation;
    state_.orientation.normalize();
  }
  dynamics_.update_kinematics(state_);
  if (!is_root_fixed_) {
    // The same joint rates are another momentum in the new configuration. The root's velocity is
    // corrected so that the whole momentum stays. The next step needs this mass matrix too.
    dynamics_.update_mass_matrix();
    momentum.angular += dynamics_.center_of_mass_from_origin().cross(momentum.linear);
    root_change_ = dynamics_.set_momentum(momentum, state_.velocity);
  }
}

bool TreeIntegrator::is_within_bounds() const {
  if (!state_.velocity.allFinite() || !state_.coordinate.allFinite() ||
      !state_.position.allFinite() || !state_.orientation.coeffs().allFinite()) {
    return false;
  }
  const auto num_joint_dofs = state_.velocity.size() - 6;
  // NaN fails the comparisons below as well; the check above gives the clear answer first.
  double rate = state_.velocity.head<3>().cwiseAbs().maxCoeff();
  if (num_joint_dofs > 0) {
    rate = std::max(rate, state_.velocity.tail(num_joint_dofs).cwiseAbs().maxCoeff());
  }
  const double speed = state_.velocity.segment<3>(3).cwiseAbs().maxCoeff();
  return rate < kMaxRate && speed < kMaxSpeed &&
         state_.position.cwiseAbs().maxCoeff() < kMaxDistance && state_.position.z() > -kMaxDepth;
}

}  // namespace nao::sim
