#include "daemons/motion/estimator/foot_pressure.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>

namespace nao::motion {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

}  // namespace

FootPressure::FootPressure(const RobotModel& model)
    : foot_(model.foot_sensors().size(), model.legs().size()),
      terms_(model.foot_sensors().size(), Vector3d(1, 0, 0)) {
  const auto poses = model.link_poses(std::vector<double>(model.num_motors(), 0.0));
  for (const LegDescription& leg : model.legs()) {
    for (const int sensor : leg.sensors) {
      const Vector3d position =
          poses[leg.sole].inverse() * poses[model.foot_sensors()[sensor]].translation();
      terms_[sensor] = {1, position.x(), position.y()};
      foot_[sensor] = feet_.size();
    }
    feet_.push_back(leg.sensors);
  }
  feet_.emplace_back();
}

double FootPressure::implied_force(size_t sensor, const std::vector<double>& force,
                                   const std::vector<bool>& is_dead) const {
  // Normal equations of the plane a + b x + c y through the forces of the others.
  Matrix3d normal = Matrix3d::Zero();
  Vector3d right_side = Vector3d::Zero();
  int num_alive = 0;
  for (const int other : sensors_of_foot(sensor)) {
    if (static_cast<size_t>(other) == sensor || is_dead[other]) continue;
    normal += terms_[other] * terms_[other].transpose();
    right_side += terms_[other] * force[other];
    ++num_alive;
  }
  if (num_alive < 3 || normal.determinant() == 0) return 0;
  return std::max(0.0, terms_[sensor].dot(normal.inverse() * right_side));
}

void FootPressure::replace_dead(const std::vector<bool>& is_dead,
                                std::vector<double>& force) const {
  for (size_t sensor = 0; sensor < terms_.size(); ++sensor) {
    if (is_dead[sensor]) force[sensor] = implied_force(sensor, force, is_dead);
  }
}

}  // namespace nao::motion
