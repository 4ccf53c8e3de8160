#include "sim/contact_damping.h"

#include <utility>

namespace nao::sim {

using Eigen::Vector3d;

void ContactDamping::add(int body_a, int body_b, const Vector3d& point,
                         const Eigen::Matrix3d& damping) {
  Contact contact{body_a, body_b, point, damping, Eigen::Matrix3Xd::Zero(3, tree_.num_dofs())};
  if (body_a >= 0) add_rows(body_a, point, 1, contact.rows);
  if (body_b >= 0) add_rows(body_b, point, -1, contact.rows);
  contacts_.push_back(std::move(contact));
}

// Adds the velocity of a body's point per generalized velocity, times a sign.
void ContactDamping::add_rows(int body, const Vector3d& point, double sign,
                              Eigen::Matrix3Xd& rows) const {
  const Vector3d arm = point - dynamics_.origin();
  for (; body > 0; body = tree_.bodies()[body].parent) {
    const SpatialVector motion = dynamics_.motion(body);
    rows.col(tree_.bodies()[body].dof) += sign * (motion.linear + motion.angular.cross(arm));
  }
  // The root: its angular velocity, and the velocity of its origin.
  for (int axis = 0; axis < 3; ++axis) {
    rows.col(axis) += sign * Vector3d::Unit(axis).cross(arm);
    rows.col(3 + axis) += sign * Vector3d::Unit(axis);
  }
}

void ContactDamping::add_to_mass(double h, Eigen::MatrixXd& mass) const {
  for (const Contact& contact : contacts_) {
    mass.noalias() += h * contact.rows.transpose() * (contact.damping * contact.rows);
  }
}

}  // namespace nao::sim
