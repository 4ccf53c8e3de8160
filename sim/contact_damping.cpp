#include "sim/contact_damping.h"

#include <algorithm>

namespace nao::sim {

using Eigen::Vector3d;

ContactDamping::Pair& ContactDamping::pair_of(int body_a, int body_b) {
  for (int i = 0; i < num_pairs_; ++i) {
    if (pairs_[i].body_a == body_a && pairs_[i].body_b == body_b) return pairs_[i];
  }
  if (num_pairs_ == static_cast<int>(pairs_.size())) pairs_.emplace_back();
  Pair& pair = pairs_[num_pairs_++];
  pair.body_a = body_a;
  pair.body_b = body_b;
  pair.damping.setZero();
  pair.rows.setZero(6, tree_.num_dofs());
  pair.dofs.clear();
  if (body_a >= 0) add_rows(body_a, 1, pair);
  if (body_b >= 0) add_rows(body_b, -1, pair);
  std::sort(pair.dofs.begin(), pair.dofs.end());
  pair.dofs.erase(std::unique(pair.dofs.begin(), pair.dofs.end()), pair.dofs.end());
  return pair;
}

void ContactDamping::add(int body_a, int body_b, const Vector3d& point,
                         const Eigen::Matrix3d& damping) {
  // The velocity of the point at an arm from O is v - arm x w.
  const Vector3d arm = point - dynamics_.origin();
  Eigen::Matrix<double, 3, 6> velocity;
  velocity << 0, arm.z(), -arm.y(), 1, 0, 0,  //
      -arm.z(), 0, arm.x(), 0, 1, 0,          //
      arm.y(), -arm.x(), 0, 0, 0, 1;
  const Eigen::Matrix<double, 3, 6> force = damping * velocity;
  pair_of(body_a, body_b).damping.noalias() += velocity.transpose() * force;
}

// Adds the spatial velocity of a body per generalized velocity, times a sign.
void ContactDamping::add_rows(int body, double sign, Pair& pair) const {
  for (; body > 0; body = tree_.bodies()[body].parent) {
    const int dof = tree_.bodies()[body].dof;
    const SpatialVector motion = dynamics_.motion(body);
    pair.rows.col(dof).head<3>() += sign * motion.angular;
    pair.rows.col(dof).tail<3>() += sign * motion.linear;
    pair.dofs.push_back(dof);
  }
  // The root: its angular velocity, and the velocity of its origin.
  for (int axis = 0; axis < 6; ++axis) {
    pair.rows(axis, axis) += sign;
    pair.dofs.push_back(axis);
  }
}

void ContactDamping::add_to_mass(double h, Eigen::MatrixXd& mass) const {
  for (int i = 0; i < num_pairs_; ++i) {
    const Pair& pair = pairs_[i];
    for (size_t column = 0; column < pair.dofs.size(); ++column) {
      const int first = pair.dofs[column];
      const Eigen::Matrix<double, 6, 1> force = h * (pair.damping * pair.rows.col(first));
      for (size_t row = column; row < pair.dofs.size(); ++row) {
        mass(pair.dofs[row], first) += pair.rows.col(pair.dofs[row]).dot(force);
      }
    }
  }
}

}  // namespace nao::sim
