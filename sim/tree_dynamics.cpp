#include "sim/tree_dynamics.h"

#include <cmath>

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
SpatialVector multiply(const SpatialInertia& i, const SpatialVector& v) {
  return {i.inertia * v.angular + i.moment.cross(v.linear),
          i.mass * v.linear - i.moment.cross(v.angular)};
}

// Power of a spatial force on a spatial motion; their dual pairing needs no metric.
double dot(const SpatialVector& motion, const SpatialVector& force) {
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
      stride_((tree.num_dofs() + 3) / 4 * 4),
      bodies_(tree.num_bodies()),
      mass_(static_cast<size_t>(num_dofs_) * stride_, 0.0),
      factor_(mass_) {
  for (int dof = 0; dof < num_dofs_; ++dof) {
    const std::vector<int>& all = tree.dof_ancestors(dof);
    // The root's six are dense for every dof and are handled by plain loops over 0..5.
    joint_ancestors_.emplace_back(all.begin() + std::min<size_t>(6, all.size()), all.end());
  }
}

void TreeDynamics::update_kinematics(const TreeState& state) {
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
        now.rotation.noalias() = parent.rotation * turn;
      } else {
        const Matrix3d fixed = parent.rotation * body.rotation_in_parent;
        now.rotation.noalias() = fixed * turn;
      }
      // R_WB = R_WP R_PB(0) R(axis, angle) above, p_WB = p_WP + R_WP p_PB here.
      now.position = parent.position + parent.rotation * body.origin_in_parent;
      // The joint's axis is the same in B at all angles.
      const Vector3d axis = body.ratio * (now.rotation * body.axis);
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
    now.com_from_O = now.rotation * body.center_of_mass + (now.position - origin_);
    const Vector3d& c = now.com_from_O;
    now.inertia.mass = body.mass;
    now.inertia.moment = body.mass * c;
    const Matrix3d turned = now.rotation * body.inertia;
    now.inertia.inertia.noalias() = turned * now.rotation.transpose();
    now.inertia.inertia.diagonal().array() += body.mass * c.squaredNorm();
    now.inertia.inertia.noalias() -= now.inertia.moment * c.transpose();
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
  // Composite rigid bodies: M(i, j) = S_j . (I_i S_i), where I_i is the inertia of everything that
  // joint i carries, and j is an ancestor of i.
  for (BodyState& now : bodies_) now.composite = now.inertia;
  // Only entries on and below the diagonal are used; the root's rows are set at the end.
  for (int dof = 6; dof < num_dofs_; ++dof) {
    double* row = &mass_[dof * stride_];
    for (int column = 0; column <= dof; ++column) row[column] = 0;
  }
  for (int index = tree_.num_bodies() - 1; index > 0; --index) {
    const TreeBody& body = tree_.bodies()[index];
    const BodyState& now = bodies_[index];
    bodies_[body.parent].composite += now.composite;
    // A mimic's body adds to the row of its leader's dof: the sum over both bodies, with their
    // ratios in S, is T^T M T of the coupled system.
    // Force for a unit acceleration of this joint.
    const SpatialVector force = multiply(now.composite, now.motion);
    double* row = &mass_[body.dof * stride_];
    row[body.dof] += dot(now.motion, force);
    for (int above = body.parent; above > 0; above = tree_.bodies()[above].parent) {
      row[tree_.bodies()[above].dof] += dot(bodies_[above].motion, force);
    }
    // Row of the joint, columns of the root: for the root S is the unit matrix, so that the entries
    // are the force itself.
    for (int k = 0; k < 3; ++k) {
      row[k] += force.angular[k];
      row[3 + k] += force.linear[k];
    }
  }
  if (is_root_fixed_) {
    // The root's rows are those of the unit matrix: it is decoupled from all joints.
    for (int dof = 0; dof < num_dofs_; ++dof) {
      double* row = &mass_[dof * stride_];
      for (int k = 0; k < std::min(dof + 1, 6); ++k) row[k] = k == dof ? 1 : 0;
    }
    return;
  }
  // The root's block: [I, h x; -h x, m 1] of the whole tree, h its first moment.
  const SpatialInertia& whole = bodies_[0].composite;
  const Vector3d& h = whole.moment;
  // -[h]x, the block that couples linear rows with angular columns.
  const double linear_angular[3][3] = {{0, h.z(), -h.y()}, {-h.z(), 0, h.x()}, {h.y(), -h.x(), 0}};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j <= i; ++j) {
      mass_[i * stride_ + j] = whole.inertia(i, j);
      mass_[(3 + i) * stride_ + 3 + j] = i == j ? whole.mass : 0;
    }
    for (int j = 0; j < 3; ++j) mass_[(3 + i) * stride_ + j] = linear_angular[i][j];
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

// The lower triangle serves for both halves: entry (i, j) adds to row i and, by symmetry, to row j.
void TreeDynamics::multiply_by_mass(const Eigen::VectorXd& x, Eigen::VectorXd& result) const {
  result.setZero();
  for (int i = 0; i < num_dofs_; ++i) {
    const double* row = &mass_[i * stride_];
    double sum = row[i] * x[i];
    const int num_root = std::min(i, 6);
    for (int j = 0; j < num_root; ++j) {
      sum += row[j] * x[j];
      result[j] += row[j] * x[i];
    }
    for (const int j : joint_ancestors_[i]) {
      sum += row[j] * x[j];
      result[j] += row[j] * x[i];
    }
    result[i] += sum;
  }
}

void TreeDynamics::factorize(const Eigen::VectorXd& diagonal) {
  // From the last dof to the first, each row changes those of its ancestors only, so that entries
  // outside the tree's pattern stay 0.
  factor_ = mass_;
  for (int i = 0; i < num_dofs_; ++i) factor_[i * stride_ + i] += diagonal[i];
  // L^T L of a tree (Featherstone, table 6.3): eliminates the leaves first, so that no fill-in
  // occurs. Row k of L is sqrt on the diagonal and M(k, j) / sqrt for its ancestors j.
  for (int k = num_dofs_ - 1; k >= 0; --k) {
    double* row = &factor_[k * stride_];
    const double root = std::sqrt(row[k]);
    const double inverse = 1 / root;
    row[k] = root;
    const int num_root = std::min(k, 6);
    for (int j = 0; j < num_root; ++j) row[j] *= inverse;
    const std::vector<int>& above = joint_ancestors_[k];
    for (const int j : above) row[j] *= inverse;
    // Schur complement: subtracts the outer product of the row from the ancestors' block.
    for (size_t a = 0; a < above.size(); ++a) {
      const int i = above[a];
      double* target = &factor_[i * stride_];
      const double factor = row[i];
      for (int j = 0; j < 6; ++j) target[j] -= factor * row[j];
      for (size_t b = 0; b <= a; ++b) target[above[b]] -= factor * row[above[b]];
    }
    for (int i = 0; i < num_root; ++i) {
      double* target = &factor_[i * stride_];
      for (int j = 0; j <= i; ++j) target[j] -= row[i] * row[j];
    }
  }
}

void TreeDynamics::solve_upper(Eigen::VectorXd& x) const {
  // x_i is final once all of its descendants have been subtracted from it; each then updates its
  // ancestors.
  // Backward substitution with the upper triangular L^T.
  for (int i = num_dofs_ - 1; i >= 0; --i) {
    const double* row = &factor_[i * stride_];
    const double value = x[i] / row[i];
    x[i] = value;
    const int num_root = std::min(i, 6);
    for (int j = 0; j < num_root; ++j) x[j] -= row[j] * value;
    for (const int j : joint_ancestors_[i]) x[j] -= row[j] * value;
  }
}

void TreeDynamics::solve_lower(Eigen::VectorXd& x) const {
  // Forward substitution with L: ancestors have smaller indices and are final already.
  for (int i = 0; i < num_dofs_; ++i) {
    const double* row = &factor_[i * stride_];
    double value = x[i];
    const int num_root = std::min(i, 6);
    for (int j = 0; j < num_root; ++j) value -= row[j] * x[j];
    for (const int j : joint_ancestors_[i]) value -= row[j] * x[j];
    x[i] = value / row[i];
  }
}

void TreeDynamics::add_jacobian(int body_index, const Vector3d& point, const Matrix3d& directions,
                                double sign, const int* position, RowEntry* entries) const {
  // Column k of J^T is the spatial force of a unit force along direction k at the point; its entry
  // for a dof is the power of the dof's motion.
  const Vector3d arm = point - origin_;
  Matrix3d moments;
  for (int k = 0; k < 3; ++k) moments.col(k) = arm.cross(directions.col(k));
  for (int axis = 0; axis < 3 && !is_root_fixed_; ++axis) {
    double* angular = entries[position[axis]].row;
    double* linear = entries[position[3 + axis]].row;
    for (int k = 0; k < 3; ++k) {
      angular[k] += sign * moments(axis, k);
      linear[k] += sign * directions(axis, k);
    }
  }
  // Joints on the way from the body to the root are the only ones that move it.
  for (int index = body_index; index > 0; index = tree_.bodies()[index].parent) {
    const SpatialVector& motion = bodies_[index].motion;
    double* row = entries[position[tree_.bodies()[index].dof]].row;
    for (int k = 0; k < 3; ++k) {
      row[k] += sign * (motion.angular.dot(moments.col(k)) + motion.linear.dot(directions.col(k)));
    }
  }
}

// The same substitution as above for three right sides at once, on a compact list of dofs that
// holds all ancestors of each. `position` maps a dof to its place in the list.
void TreeDynamics::solve_upper(const int* dofs, int count, const int* position,
                               RowEntry* entries) const {
  for (int k = count - 1; k >= 0; --k) {
    const int dof = dofs[k];
    const double* factor = &factor_[dof * stride_];
    RowEntry& entry = entries[k];
    const double inverse = 1 / factor[dof];
    for (double& value : entry.row) value *= inverse;
    // The root's six are the first six of every list.
    const int num_root = std::min(dof, 6);
    for (int j = 0; j < num_root; ++j) {
      for (int lane = 0; lane < 4; ++lane) entries[j].row[lane] -= factor[j] * entry.row[lane];
    }
    for (const int above : joint_ancestors_[dof]) {
      RowEntry& target = entries[position[above]];
      for (int lane = 0; lane < 4; ++lane) target.row[lane] -= factor[above] * entry.row[lane];
    }
  }
}

double TreeDynamics::mass_matrix(int row, int column) const {
  return row >= column ? mass_[row * stride_ + column] : mass_[column * stride_ + row];
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

// Adds one rigid motion to the velocities of all bodies, so that joint rates stay: the motion that
// the whole tree, as a rigid body, has with the missing momentum.
SpatialVector TreeDynamics::set_momentum(const SpatialVector& target, Eigen::VectorXd& velocity) {
  const SpatialVector present = momentum();
  SpatialInertia whole;
  for (const BodyState& now : bodies_) whole += now.inertia;
  SpatialVector change =
      motion_of(whole, {target.angular - present.angular, target.linear - present.linear});
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
