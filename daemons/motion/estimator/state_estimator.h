#pragma once

#include <optional>
#include <vector>

#include "daemons/motion/estimator/body_outline.h"
#include "daemons/motion/estimator/ground_reaction.h"
#include "daemons/motion/estimator/orientation_check.h"
#include "daemons/motion/estimator/orientation_filter.h"
#include "daemons/motion/robot_state.h"
#include "daemons/motion/sensors.h"
#include "kinematics/kinematics.h"
#include "robot_model/robot_model.h"

namespace nao::motion {

/** Estimates the robot's state from its sensors. T is the torso frame, O the odometry frame.
 *
 * - Orientation R_OT: OrientationFilter.
 * - Contact: a foot carries weight when the sum of its force sensors exceeds a threshold (with
 *   hysteresis). The sensors are assigned to the feet by the links that carry them; a foot may have
 *   any number of them. If a foot has none, forces and center of pressure come from the joint
 *   torques (GroundReaction).
 * - Position: leg odometry. The foot with more load is the support foot and does not move: with its
 *   sole origin p_TS from forward kinematics and p_OS constant,
 *       p_OT = p_OS - R_OT p_TS        (x and y),
 *   and the height is such that the lowest point of the body touches the ground (z = 0). When the
 *   other foot takes over, p_OS advances by R_OT (p_TS' - p_TS).
 * - Velocities: finite differences through a first-order low-pass filter.
 * - Center of pressure: p = sum_i f_i p_i / sum_i f_i over all force sensors.
 * - Support polygon: convex hull of the outlines of the soles that carry weight; the balance margin
 *   is the distance of the center of mass's ground projection to its edge. */
class StateEstimator {
 public:
  /** @param model  Must outlive this. */
  explicit StateEstimator(const RobotModel& model);

  /** Restarts: the next update() places the odometry frame below the torso. */
  void reset();

  /** Adds the measurements of one control step. @param dt  Time since the last ones, s. */
  void update(const Sensors& sensors, double dt);

  /** As of the last update(). */
  const RobotState& state() const { return state_; }
  /** For the measured joint angles of the last update(). */
  const Kinematics& kinematics() const { return kinematics_; }

 private:
  void detect_rest(const Sensors& sensors, double dt);
  void estimate_orientation(const Sensors& sensors, double dt);
  void measure_foot_forces(const Sensors& sensors);
  void update_support_foot();
  void estimate_position();
  void estimate_velocity(double dt);
  void find_support(const Sensors& sensors);
  Eigen::Vector3d calc_center_of_pressure(const Sensors& sensors) const;
  const Eigen::Isometry3d& sole(bool is_left) const {
    return is_left ? kinematics_.left_sole() : kinematics_.right_sole();
  }

  const RobotModel* model_;
  ContactForces contact_forces_;
  /** For each foot force sensor whether it is on the left foot. */
  std::vector<bool> is_left_sensor_;
  /** For a robot without force sensors, and what it found in the last update. */
  std::optional<GroundReaction> ground_reaction_;
  std::array<FootReaction, 2> reactions_;
  Kinematics kinematics_;
  BodyOutline outline_;
  OrientationFilter orientation_;
  OrientationCheck orientation_check_;
  RobotState state_;
  bool is_started_ = false;
  double rest_time_ = 0;
  /** Of the gyroscope, in T, rad/s. */
  Eigen::Vector3d mean_rate_ = Eigen::Vector3d::Zero();

  bool is_left_support_ = true;
  /** p_OS: x and y of the support foot's sole in O, m. */
  Eigen::Vector2d support_sole_in_odometry_ = Eigen::Vector2d::Zero();
  Eigen::Vector3d last_torso_position_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d last_center_of_mass_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d torso_velocity_in_odometry_ = Eigen::Vector3d::Zero();
};

/** Hull of the soles that carry a robot, projected on the floor; see
 * RobotState::support_polygon_in_odometry. */
std::vector<Eigen::Vector2d> calc_support_polygon(const RobotModel& model, const RobotState& state);

}  // namespace nao::motion
