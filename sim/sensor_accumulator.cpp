#include "sim/sensor_accumulator.h"

#include "common/rotation.h"

namespace nao::sim {

using Eigen::Matrix3d;
using Eigen::Vector3d;

SensorAccumulator::SensorAccumulator(const RobotModel& model, const Tree& tree,
                                     const Vector3d& gravity)
    : gravity_(gravity),
      // On a slope gravity is tilted in W, while an IMU knows "up" as against gravity: its level
      // frame is W turned by the rotation from -g to z.
      level_from_world_(
          rotation_between(Vector3d(-gravity.normalized()), Vector3d(Vector3d::UnitZ()))),
      is_floor_level_(gravity.head<2>().isZero(0)),
      torque_impulse_(Eigen::VectorXd::Zero(model.num_motors())) {
  if (model.accelerometer() >= 0) {
    accelerometer_body_ = tree.body_of_link(model.accelerometer());
    accelerometer_in_body_ = tree.pose_in_body(model.accelerometer());
  }
  // Foot forces are summed in the frames of the soles.
  for (size_t side = 0; side < soles_.size(); ++side) {
    const int link = model.legs()[side].sole;
    if (link < 0) continue;
    soles_[side] = {tree.body_of_link(link), tree.pose_in_body(link)};
  }
}

// Velocity of the accelerometer at the start of the tick: means are differences of velocities,
// which cannot miss an impact between two samples.
void SensorAccumulator::begin_tick(const TreeDynamics& dynamics) {
  time_ = 0;
  torque_impulse_.setZero();
  velocity_change_.setZero();
  rotation_.setZero();
  foot_impulse_ = {};
  accelerometer_velocity_.setZero();
  if (accelerometer_body_ < 0) return;
  const Vector3d position =
      (dynamics.pose(accelerometer_body_) * accelerometer_in_body_).translation();
  accelerometer_velocity_ = dynamics.velocity_at(accelerometer_body_, position);
}

void SensorAccumulator::add_step(double h, const TreeState& state, const TreeDynamics& dynamics,
                                 const Eigen::VectorXd& torque) {
  torque_impulse_ += h * torque;
  // The readings are in the torso's axes; each step's change is rotated with the pose of that step,
  // as a strapdown unit would measure it.
  const Matrix3d torso_from_world = dynamics.rotation(0).transpose();
  if (accelerometer_body_ >= 0) {
    const Vector3d position =
        dynamics.position(accelerometer_body_) +
        dynamics.rotation(accelerometer_body_) * accelerometer_in_body_.translation();
    const Vector3d velocity = dynamics.velocity_at(accelerometer_body_, position);
    velocity_change_ += torso_from_world * (velocity - accelerometer_velocity_);
    accelerometer_velocity_ = velocity;
  }
  // Integral of the angular velocity in the torso's axes, rad. For the small angle of a tick the
  // order of rotations does not matter.
  rotation_ += h * (torso_from_world * state.velocity.head<3>());
  time_ += h;
}

void SensorAccumulator::add_foot_impulse(int foot, const Vector3d& point, const Vector3d& impulse,
                                         const TreeDynamics& dynamics) {
  const Sole& sole = soles_[foot];
  const Matrix3d& rotation = dynamics.rotation(sole.body);
  const Matrix3d sole_from_world = (rotation * sole.pose_in_body.linear()).transpose();
  const Vector3d origin = dynamics.position(sole.body) + rotation * sole.pose_in_body.translation();
  // Foot sensors measure the component along the sole's normal.
  const double normal_impulse = sole_from_world.row(2).dot(impulse);
  const Vector3d point_in_sole = sole_from_world * (point - origin);
  foot_impulse_[foot].force += normal_impulse;
  // Moment as sum of force times point: divided by the force it is the center of pressure.
  foot_impulse_[foot].moment += normal_impulse * point_in_sole.head<2>();
}

const TrueMotion& SensorAccumulator::means(const Eigen::VectorXd& position,
                                           const Eigen::VectorXd& torque, const TreeState& state,
                                           const TreeDynamics& dynamics) {
  means_.position = position;
  means_.torque = torque;
  means_.orientation = is_floor_level_ ? state.orientation : level_from_world_ * state.orientation;
  // An accelerometer at rest reads -g: specific force f = a - g, in the torso's axes.
  means_.specific_force = -(dynamics.rotation(0).transpose() * gravity_);
  means_.angular_velocity.setZero();
  means_.feet = {};
  // Right after a jump no time has passed: the readings are those of a robot at rest.
  if (time_ > 0) {
    means_.torque = torque_impulse_ / time_;
    means_.specific_force += velocity_change_ / time_;
    means_.angular_velocity = rotation_ / time_;
    for (int side = 0; side < 2; ++side) {
      means_.feet[side].force = foot_impulse_[side].force / time_;
      means_.feet[side].moment = foot_impulse_[side].moment / time_;
    }
  }
  return means_;
}

}  // namespace nao::sim
