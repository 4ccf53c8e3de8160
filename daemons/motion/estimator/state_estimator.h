#pragma once

#include "daemons/motion/estimator/body_outline.h"
#include "daemons/motion/estimator/orientation_filter.h"
#include "daemons/motion/robot_state.h"
#include "daemons/motion/sensors.h"
#include "kinematics/kinematics.h"
#include "robot_model/robot_model.h"

namespace nao::motion {

/** Estimates the robot's state from its sensors: orientation from the inertial unit, feet's load
 * from their force sensors, position by standing on one foot after the other (odometry). The model
 * must outlive it. */
class StateEstimator {
 public:
  /** @param contact_force  Least force on a foot that carries weight, N. */
  StateEstimator(const RobotModel& model, double contact_force);

  /** Forgets everything: the next update() starts with the odometry frame below the torso. */
  void reset();

  /** Takes in one tick's measurements. @param dt  s since the last ones. */
  void update(const Sensors& sensors, double dt);

  /** As of the last update(). */
  const RobotState& state() const { return state_; }
  /** For the measured joint angles of the last update(). */
  const Kinematics& kinematics() const { return kinematics_; }

 private:
  void weigh_feet(const Sensors& sensors);
  void watch_rest(const Sensors& sensors, double dt);
  void stand_on_foot();
  void measure_velocity(double dt);
  void find_support(const Sensors& sensors);
  const Eigen::Isometry3d& sole(bool is_left) const {
    return is_left ? kinematics_.left_sole() : kinematics_.right_sole();
  }

  const RobotModel* model_;
  double contact_force_;
  Kinematics kinematics_;
  BodyOutline outline_;
  OrientationFilter orientation_;
  RobotState state_;
  bool is_started_ = false;
  double rest_time_ = 0;

  /** The foot that stands still, and where its sole is in O (level, on the ground). */
  bool stands_on_left_ = true;
  Eigen::Vector2d standing_sole_in_odometry_ = Eigen::Vector2d::Zero();
  Eigen::Vector3d last_torso_position_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d last_center_of_mass_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d torso_velocity_in_odometry_ = Eigen::Vector3d::Zero();
};

}  // namespace nao::motion
