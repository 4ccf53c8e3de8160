#pragma once

#include <Eigen/Core>
#include <array>

#include "robot_model/robot_model.h"
#include "sim/sensors.h"
#include "sim/tree.h"
#include "sim/tree_dynamics.h"

namespace nao::sim {

/** Sums of what one robot's sensors measure, over the steps of a control tick: real sensors average
 * over some time, and an impact within a tick must not be missed. */
class SensorAccumulator {
 public:
  /** @param tree  Must outlive this. @param gravity  m/s^2, in W. */
  SensorAccumulator(const RobotModel& model, const Tree& tree, const Eigen::Vector3d& gravity);

  /** Starts a tick. */
  void begin_tick(const TreeDynamics& dynamics);
  /** Adds a step of h seconds. @param state, dynamics  At its end. @param torque  Of the motors in
   * the step, N m. */
  void add_step(double h, const TreeState& state, const TreeDynamics& dynamics,
                const Eigen::VectorXd& torque);
  /** Adds an impulse of the floor on a sole, N s, at a point; both in W.
   * @param foot  0 left, 1 right. */
  void add_foot_impulse(int foot, const Eigen::Vector3d& point, const Eigen::Vector3d& impulse,
                        const TreeDynamics& dynamics);

  /** The motors' torques integrated over the tick so far, N m s. */
  const Eigen::VectorXd& torque_impulse() const { return torque_impulse_; }
  /** Means over the tick so far; at its beginning the values at rest.
   * @param position, torque  Positions and torques of the motors now. */
  const TrueMotion& means(const Eigen::VectorXd& position, const Eigen::VectorXd& torque,
                          const TreeState& state, const TreeDynamics& dynamics);

 private:
  struct Sole {
    int body = 0;
    Eigen::Isometry3d pose_in_body = Eigen::Isometry3d::Identity();
  };

  Eigen::Vector3d gravity_;
  /** Frame whose z axis is against gravity, from W; the identity on a level floor. */
  Eigen::Quaterniond level_from_world_;
  bool is_floor_level_;
  /** Body that carries the accelerometer, and where, m; body -1 if the robot has none. */
  int accelerometer_body_ = -1;
  Eigen::Isometry3d accelerometer_in_body_ = Eigen::Isometry3d::Identity();
  std::array<Sole, 2> soles_;

  double time_ = 0;
  Eigen::VectorXd torque_impulse_;
  /** Sum of the accelerometer's changes of velocity, m/s, each in the torso frame of its time. */
  Eigen::Vector3d velocity_change_ = Eigen::Vector3d::Zero();
  /** Velocity of the accelerometer at the end of the last step, m/s, in W. */
  Eigen::Vector3d accelerometer_velocity_ = Eigen::Vector3d::Zero();
  /** Integral of the torso's angular velocity, rad, in the torso frame. */
  Eigen::Vector3d rotation_ = Eigen::Vector3d::Zero();
  /** Impulses and their moments. */
  std::array<TrueMotion::FootLoad, 2> foot_impulse_;
  TrueMotion means_;
};

}  // namespace nao::sim
