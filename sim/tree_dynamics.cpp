#include "sim/tree_dynamics.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "sim/products.h"

namespace nao::sim {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/** Rotation by an angle about a unit axis (Rodrigues' formula). */
Matrix3d rotation_about(const Vector3d& a, double angle) {
  const double s = std::sin(angle);
  const double c = std::cos(angle);
  const Vector3d t = (1 - c) * a;
  Matrix3d r;
  r << t.x() * a.x() + c, t.x() * a.y() - s * a.z(), t.x() * a.z() + s * a.y(),  //
      t.x() * a.y() + s * a.z(), t.y() * a.y() + c, t.y() * a.z() - s * a.x(),   //
      t.x() * a.z() - s * a.y(), t.y() * a.z() + s * a.x(), t.z() * a.z() + c;
  return r;
}

/** Momentum of a body with a velocity. */
// Spatial inertia times spatial velocity, both about O: angular momentum I w + h x v and linear
// momentum m v - h x w, with the first moment h = m c.
[[gnu::always_inline]] inline SpatialVector multiply(const SpatialInertia& i,
                                                     const SpatialVector& v) {
  return {product(i.inertia, v.angular) + i.moment.cross(v.linear),
          i.mass * v.linear - i.moment.cross(v.angular)};
}

// Power of a spatial force on a spatial motion; their dual pairing needs no metric.
[[gnu::always_inline]] inline double dot(const SpatialVector& motion, const SpatialVector& force) {
  return motion.angular.dot(force.angular) + motion.linear.dot(force.linear);
}

/** Velocity of a rigid body that has a momentum, both about O: the inverse of multiply(). */
SpatialVector motion_of(const SpatialInertia& body, const SpatialVector& momentum) {
  // Inverse by the center of mass, where angular and linear parts decouple: L_c = L - c x p, w =
  // I_c^-1 L_c, v = p / m - w x c.
  const Vector3d center = body.moment / body.mass;
  // Inertia about the center of mass, by the parallel axis theorem.
  Matrix3d central = body.inertia;
  central.diagonal().array() -= body.mass * center.squaredNorm();
  central += body.moment * center.transpose();
  SpatialVector motion;
  motion.angular = central.inverse() * (momentum.angular - center.cross(momentum.linear));
  motion.linear = momentum.linear / body.mass - motion.angular.cross(center);
  return motion;
}

}  // namespace

TreeDynamics::TreeDynamics(const Tree& tree, bool is_root_fixed)
    : tree_(tree),
      is_root_fixed_(is_root_fixed),
      num_dofs_(tree.num_dofs()),
      bodies_(tree.num_bodies()) {
  size_t depth = 0;
  for (int dof = 0; dof < num_dofs_; ++dof) {
    depth = std::max(depth, tree.dof_ancestors(dof).size());
  }
  pairs_of_row_ = num_pairs(static_cast<int>(depth) + 1);
  for (std::vector<EntryPair>* rows : {&mass_, &factor_, &inverse_}) {
    rows->assign(static_cast<size_t>(num_dofs_) * pairs_of_row_, EntryPair::Zero());
  }
  rows_above_.resize(depth);
  factors_above_.resize(depth);
}

void TreeDynamics::update_kinematics(const TreeState& state) {
  has_mass_matrix_ = false;
  // O is the root's origin at this state: all spatial vectors of the step are about this fixed
  // point.
  origin_ = state.position;
  // Parents come before their children, so that one pass from the root outwards suffices.
  for (int index = 0; index < tree_.num_bodies(); ++index) {
    const TreeBody& body = tree_.bodies()[index];
    BodyState& now = bodies_[index];
    if (body.parent < 0) {
      now.rotation = state.orientation.toRotationMatrix();
      now.position = state.position;
      now.velocity.angular = state.velocity.head<3>();
      now.velocity.linear = state.velocity.segment<3>(3);
    } else {
      const BodyState& parent = bodies_[body.parent];
      const double angle = body.ratio * state.coordinate[body.dof] + body.offset;
      const Matrix3d turn = rotation_about(body.axis, angle);
      if (body.is_parallel) {
        now.rotation = product(parent.rotation, turn);
      } else {
        now.rotation = product(product(parent.rotation, body.rotation_in_parent), turn);
      }
      // R_WB = R_WP R_PB(0) R(axis, angle) above, p_WB = p_WP + R_WP p_PB here.
      now.position = parent.position + product(parent.rotation, body.origin_in_parent);
      // The joint's axis is the same in B at all angles.
      const Vector3d axis = body.ratio * product(now.rotation, body.axis);
      // Spatial motion S of a revolute joint about O: angular part the axis, linear part the
      // velocity of the point at O, which is (p_WB - O) x axis. The ratio is 1 unless the joint is
      // a mimic.
      now.motion.angular = axis;
      now.motion.linear = (now.position - origin_).cross(axis);
      const double rate = now.rate = state.velocity[body.dof];
      now.velocity.angular = parent.velocity.angular + rate * axis;
      now.velocity.linear = parent.velocity.linear + rate * now.motion.linear;
    }
    // Inertia about O in W's axes: rotated, and moved by the parallel axis theorem.
    now.com_from_O = product(now.rotation, body.center_of_mass) + (now.position - origin_);
    const Vector3d& c = now.com_from_O;
    now.inertia.mass = body.mass;
    now.inertia.moment = body.mass * c;
    Matrix3d turned = rotated(now.rotation, body.inertia);
    turned.diagonal().array() += body.mass * c.squaredNorm();
    now.inertia.inertia = minus_outer(turned, now.inertia.moment, c);
  }
}

// With the poses unchanged the motions S are unchanged: velocities are sums of rate * S.
void TreeDynamics::update_velocities(const TreeState& state) {
  bodies_[0].velocity.angular = state.velocity.head<3>();
  bodies_[0].velocity.linear = state.velocity.segment<3>(3);
  for (int index = 1; index < tree_.num_bodies(); ++index) {
    BodyState& now = bodies_[index];
    const BodyState& parent = bodies_[tree_.bodies()[index].parent];
    now.rate = state.velocity[tree_.bodies()[index].dof];
    now.velocity.angular = parent.velocity.angular + now.rate * now.motion.angular;
    now.velocity.linear = parent.velocity.linear + now.rate * now.motion.linear;
  }
}

void TreeDynamics::update_mass_matrix() {
  if (has_mass_matrix_) return;
  has_mass_matrix_ = true;
  // Composite rigid bodies: M(i, j) = S_j . (I_i S_i), where I_i is the inertia of everything that
  // joint i carries, and j is an ancestor of i.
  for (BodyState& now : bodies_) now.composite = now.inertia;
  // The root's rows are set at the end.
  std::fill(mass_.begin() + 6 * pairs_of_row_, mass_.end(), EntryPair::Zero());
  for (int index = tree_.num_bodies() - 1; index > 0; --index) {
    const TreeBody& body = tree_.bodies()[index];
    const BodyState& now = bodies_[index];
    bodies_[body.parent].composite += now.composite;
    // A mimic's body adds to the row of its leader's dof: the sum over both bodies, with their
    // ratios in S, is T^T M T of the coupled system.
    // Force for a unit acceleration of this joint.
    const SpatialVector force = multiply(now.composite, now.motion);
    double* row = row_of(mass_, body.dof);
    if (body.is_in_series) {
      // The body's chain: the root's six, then a joint for each body on the way.
      auto place = body.chain.size() - 1;
      row[place] += dot(now.motion, force);
      for (int above = body.parent; above > 0; above = tree_.bodies()[above].parent) {
        row[--place] += dot(bodies_[above].motion, force);
      }
    } else {
      add_coupled_body(index, force);
    }
    if (is_root_fixed_) continue;
    // Row of the joint, columns of the root: for the root S is the unit matrix, so that the entries
    // are the force itself.
    for (int k = 0; k < 3; ++k) {
      row[k] += force.angular[k];
      row[3 + k] += force.linear[k];
    }
  }
  if (is_root_fixed_) {
    // The root's rows are those of the unit matrix: it is decoupled from all joints.
    for (int dof = 0; dof < 6; ++dof) row_of(mass_, dof)[dof] = 1;
    return;
  }
  // The root's block: [I, h x; -h x, m 1] of the whole tree, h its first moment.
  const SpatialInertia& whole = bodies_[0].composite;
  const Vector3d& h = whole.moment;
  // -[h]x, the block that couples linear rows with angular columns.
  const double linear_angular[3][3] = {{0, h.z(), -h.y()}, {-h.z(), 0, h.x()}, {h.y(), -h.x(), 0}};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j <= i; ++j) {
      row_of(mass_, i)[j] = whole.inertia(i, j);
      row_of(mass_, 3 + i)[3 + j] = i == j ? whole.mass : 0;
    }
    for (int j = 0; j < 3; ++j) row_of(mass_, 3 + i)[j] = linear_angular[i][j];
  }
}

// A dof may move several bodies of one chain, and a body's dof may come before those of the bodies
// above it.
void TreeDynamics::add_coupled_body(int index, const SpatialVector& force) {
  const int dof = tree_.bodies()[index].dof;
  for (int above = index; above > 0; above = tree_.bodies()[above].parent) {
    const int other = tree_.bodies()[above].dof;
    const double entry = dot(bodies_[above].motion, force);
    const std::vector<int>& ancestors = tree_.dof_ancestors(std::max(dof, other));
    const auto place = std::lower_bound(ancestors.begin(), ancestors.end(), std::min(dof, other));
    // Off the diagonal of the bodies' matrix there are two entries, which one dof adds up.
    const bool is_twice = dof == other && above != index;
    row_of(mass_, std::max(dof, other))[place - ancestors.begin()] += is_twice ? 2 * entry : entry;
  }
}

void TreeDynamics::calc_bias(const Vector3d& gravity, Eigen::VectorXd& bias) {
  // Recursive Newton-Euler with generalized accelerations of 0. Outwards: velocity-product
  // accelerations, and the forces that they need. Gravity is an upward acceleration of the root. A
  // root whose velocity is constant has the spatial acceleration -omega x v (Featherstone 2.11).
  bias.setZero();
  for (int index = 0; index < tree_.num_bodies(); ++index) {
    const TreeBody& body = tree_.bodies()[index];
    BodyState& now = bodies_[index];
    const SpatialVector& v = now.velocity;
    if (body.parent < 0) {
      now.acceleration.angular.setZero();
      now.acceleration.linear = -v.angular.cross(v.linear) - gravity;
    } else {
      // a = a_parent + v x (S q'): the time derivative of S q' in a fixed frame, as spatial cross
      // product (w x w_s, w x v_s + v x w_s).
      const BodyState& parent = bodies_[body.parent];
      const double rate = now.rate;
      const Vector3d turning = rate * now.motion.angular;
      const Vector3d moving = rate * now.motion.linear;
      now.acceleration.angular = parent.acceleration.angular + v.angular.cross(turning);
      now.acceleration.linear =
          parent.acceleration.linear + v.angular.cross(moving) + v.linear.cross(turning);
    }
    // f = I a + v x* (I v): the momentum's rate of change, with the force cross product (w x n + v
    // x f, w x f).
    const SpatialVector momentum = multiply(now.inertia, v);
    now.force = multiply(now.inertia, now.acceleration);
    now.force.angular += v.angular.cross(momentum.angular) + v.linear.cross(momentum.linear);
    now.force.linear += v.angular.cross(momentum.linear);
  }
  // Inwards: forces through the joints.
  for (int index = tree_.num_bodies() - 1; index > 0; --index) {
    const TreeBody& body = tree_.bodies()[index];
    const BodyState& now = bodies_[index];
    // Generalized bias force: power of the joint's motion.
    bias[body.dof] += dot(now.motion, now.force);
    bodies_[body.parent].force.angular += now.force.angular;
    bodies_[body.parent].force.linear += now.force.linear;
  }
  if (is_root_fixed_) return;
  bias.head<3>() = bodies_[0].force.angular;
  bias.segment<3>(3) = bodies_[0].force.linear;
}

Eigen::Isometry3d TreeDynamics::pose(int body) const {
  Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
  result.linear() = bodies_[body].rotation;
  result.translation() = bodies_[body].position;
  return result;
}

Vector3d TreeDynamics::center_of_mass_from_origin() const {
  Vector3d moment = Vector3d::Zero();
  for (const BodyState& now : bodies_) moment += now.inertia.moment;
  return moment / tree_.total_mass();
}

SpatialVector TreeDynamics::momentum() const {
  SpatialVector sum;
  for (const BodyState& now : bodies_) {
    const SpatialVector part = multiply(now.inertia, now.velocity);
    sum.angular += part.angular;
    sum.linear += part.linear;
  }
  return sum;
}

SpatialVector TreeDynamics::rigid_motion(const SpatialVector& momentum) const {
  return motion_of(bodies_[0].composite, momentum);
}

// The root's rows of M u: the root's generalized momentum is that of the whole tree about O.
SpatialVector TreeDynamics::momentum_at(const Eigen::VectorXd& velocity) const {
  std::array<double, 6> sum{};
  const double* u = velocity.data();
  for (int i = 0; i < 6; ++i) {
    const double* row = row_of(mass_, i);
    for (int j = 0; j < i; ++j) {
      sum[i] += row[j] * u[j];
      sum[j] += row[j] * u[i];
    }
    sum[i] += row[i] * u[i];
  }
  for (int dof = 6; dof < num_dofs_; ++dof) {
    const double* row = row_of(mass_, dof);
    for (int i = 0; i < 6; ++i) sum[i] += row[i] * u[dof];
  }
  return {{sum[0], sum[1], sum[2]}, {sum[3], sum[4], sum[5]}};
}

// Adds one rigid motion to the velocities of all bodies, so that joint rates stay: the motion that
// the whole tree, as a rigid body, has with the missing momentum.
SpatialVector TreeDynamics::set_momentum(const SpatialVector& target, Eigen::VectorXd& velocity) {
  const SpatialVector present = momentum_at(velocity);
  SpatialVector change =
      rigid_motion({target.angular - present.angular, target.linear - present.linear});
  for (BodyState& now : bodies_) {
    now.velocity.angular += change.angular;
    now.velocity.linear += change.linear;
  }
  velocity.head<3>() += change.angular;
  velocity.segment<3>(3) += change.linear;
  return change;
}

Vector3d TreeDynamics::linear_momentum() const {
  return momentum().linear;
}

Vector3d TreeDynamics::angular_momentum() const {
  const SpatialVector about_O = momentum();
  // Moved from O to the center of mass: L_c = L_O - c x p.
  return about_O.angular - (center_of_mass() - origin_).cross(about_O.linear);
}

double TreeDynamics::kinetic_energy() const {
  double sum = 0;
  for (const BodyState& now : bodies_) {
    // T = v . I v / 2, summed over the bodies.
    sum += dot(now.velocity, multiply(now.inertia, now.velocity)) / 2;
  }
  return sum;
}

}  // namespace nao::sim
