#include "sim/tree_dynamics.h"

#include <algorithm>
#include <map>

#include "sim/products.h"

namespace nao::sim {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

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

/** All dofs but the root's: in turn one of each limb, from its last to its first. A row waits for
 * those of its descendants, and so the processor has others to work on. */
std::vector<int> make_elimination_order(const Tree& tree) {
  // A limb's dofs share its first one, which is the first ancestor behind the root's six.
  std::map<int, std::vector<int>> limbs;
  for (int dof = 6; dof < tree.num_dofs(); ++dof) {
    const std::vector<int>& above = tree.dof_ancestors(dof);
    limbs[above.size() > 6 ? above[6] : dof].push_back(dof);
  }
  std::vector<int> order;
  while (static_cast<int>(order.size()) < tree.num_dofs() - 6) {
    for (auto& [first, dofs] : limbs) {
      if (dofs.empty()) continue;
      order.push_back(dofs.back());
      dofs.pop_back();
    }
  }
  return order;
}

}  // namespace

TreeDynamics::TreeDynamics(const Tree& tree, bool is_root_fixed, const TreeKernels& kernels)
    : tree_(tree),
      is_root_fixed_(is_root_fixed),
      num_dofs_(tree.num_dofs()),
      kernels_(kernels),
      constants_(tree.num_bodies()),
      elimination_order_(make_elimination_order(tree)),
      bodies_(tree.num_bodies()) {
  size_t depth = 0;
  for (int dof = 0; dof < num_dofs_; ++dof) {
    depth = std::max(depth, tree.dof_ancestors(dof).size());
  }
  // Four entries at a time.
  pairs_of_row_ = 2 * static_cast<int>(depth / 4 + 1);
  for (std::vector<EntryPair>* rows : {&mass_, &factor_, &inverse_}) {
    rows->assign(static_cast<size_t>(num_dofs_) * pairs_of_row_, EntryPair::Zero());
  }
  inverse_squares_.assign(num_dofs_, 0);
  const int row_length = 2 * pairs_of_row_;
  matrix_rows_.resize(num_dofs_);
  ancestor_rows_.reserve(num_dofs_ * depth);
  for (int dof = 0; dof < num_dofs_; ++dof) {
    const std::vector<int>& above = tree.dof_ancestors(dof);
    matrix_rows_[dof] = {row_length * dof, static_cast<int>(above.size()),
                         ancestor_rows_.data() + ancestor_rows_.size()};
    for (const int ancestor : above) ancestor_rows_.push_back(row_length * ancestor);
  }
  for (int index = 0; index < tree.num_bodies(); ++index) {
    const TreeBody& body = tree.bodies()[index];
    BodyConstants& constants = constants_[index];
    constants.parent = body.parent;
    constants.dof = body.dof;
    constants.is_parallel = body.is_parallel;
    constants.row = row_length * body.dof;
    constants.place = body.is_in_series ? static_cast<int>(body.chain.size()) - 1 : -1;
    constants.ratio = body.ratio;
    constants.offset = body.offset;
    constants.mass = body.mass;
    constants.axis = body.axis;
    constants.origin_in_parent = body.origin_in_parent;
    constants.rotation_in_parent = body.rotation_in_parent;
    constants.center_of_mass = body.center_of_mass;
    constants.inertia = body.inertia;
  }
}

void TreeDynamics::update_kinematics(const TreeState& state) {
  has_mass_matrix_ = false;
  // O is the root's origin at this state: all spatial vectors of the step are about this fixed
  // point.
  origin_ = state.position;
  BodyState& root = bodies_[0];
  root.rotation = Matrix3d(state.orientation.toRotationMatrix());
  root.position = state.position;
  root.velocity = SpatialVector(state.velocity.head<3>(), state.velocity.segment<3>(3));
  kernels_.update_kinematics(constants_.data(), tree_.num_bodies(), state.coordinate.data(),
                             state.velocity.data(), bodies_.data());
}

void TreeDynamics::update_velocities(const TreeState& state) {
  bodies_[0].velocity = SpatialVector(state.velocity.head<3>(), state.velocity.segment<3>(3));
  kernels_.update_velocities(constants_.data(), tree_.num_bodies(), state.velocity.data(),
                             bodies_.data());
}

void TreeDynamics::update_mass_matrix() {
  if (has_mass_matrix_) return;
  has_mass_matrix_ = true;
  // The root's rows are set at the end.
  std::fill(mass_.begin() + 6 * pairs_of_row_, mass_.end(), EntryPair::Zero());
  kernels_.add_mass_rows(constants_.data(), tree_.num_bodies(), is_root_fixed_, bodies_.data(),
                         mass_.data()->data());
  for (int index = tree_.num_bodies() - 1; index > 0; --index) {
    if (!tree_.bodies()[index].is_in_series) add_coupled_body(index);
  }
  if (is_root_fixed_) {
    // The root's rows are those of the unit matrix: it is decoupled from all joints.
    for (int dof = 0; dof < 6; ++dof) row_of(mass_, dof)[dof] = 1;
    return;
  }
  // The root's block: [I, h x; -h x, m 1] of the whole tree, h its first moment.
  const SpatialInertia whole = bodies_[0].composite;
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
void TreeDynamics::add_coupled_body(int index) {
  const SpatialVector force = bodies_[index].unit_force;
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
  bias.setZero();
  kernels_.calc_bias(constants_.data(), tree_.num_bodies(), gravity.data(), bodies_.data(),
                     bias.data());
  if (is_root_fixed_) return;
  bias.head<3>() = Vector3d(bodies_[0].force.angular);
  bias.segment<3>(3) = Vector3d(bodies_[0].force.linear);
}

Eigen::Isometry3d TreeDynamics::pose(int body) const {
  Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
  result.linear() = rotation(body);
  result.translation() = position(body);
  return result;
}

Vector3d TreeDynamics::center_of_mass_from_origin() const {
  Vector3d moment = Vector3d::Zero();
  for (const BodyState& now : bodies_) moment += Vector3d(now.inertia.moment);
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
  const SpatialVector present = momentum_at(velocity);
  SpatialVector change =
      rigid_motion({target.angular - present.angular, target.linear - present.linear});
  for (BodyState& now : bodies_) {
    const SpatialVector before = now.velocity;
    now.velocity = SpatialVector(before.angular + change.angular, before.linear + change.linear);
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
