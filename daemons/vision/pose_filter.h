#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "daemons/vision/field_model.h"
#include "daemons/vision/field_observation.h"
#include "kinematics/pose2.h"

namespace nao::vision {

/** Extended Kalman filter of the pose on the field: x, y, m, heading, rad, and the error of the
 * camera's tilt about the x and y axes of the heading frame, rad.
 *
 * The tilt's error (joint zeros, backlash, orientation of the torso) moves all points of an image
 * together, most those far away; as part of the state it is estimated from them. It is a
 * first-order Gauss-Markov process. Faster changes of the tilt are noise that the measurements of
 * an image have in common. */
class PoseFilter {
 public:
  using State = Eigen::Matrix<double, 5, 1>;
  using Covariance = Eigen::Matrix<double, 5, 5>;

  /** @param field  Must outlive this. */
  explicit PoseFilter(const FieldModel& field);

  /** Starts at a pose. @param position_sigma  m. @param heading_sigma  rad. */
  void start(const Pose2& pose, double position_sigma, double heading_sigma);

  /** Moves the estimate by a step of the odometry, in the robot's frame. @param dt  s. */
  void predict(const Pose2& step, double dt);
  /** Makes the estimate less certain, by standard deviations, m and rad. */
  void spread(double position_sigma, double heading_sigma);

  /** Takes the lines, circle and posts of an image that fit what the field has there. */
  void update(const FieldObservation& observation);

  Pose2 pose() const { return {state_.head<2>(), state_[2]}; }
  /** Of x, y and heading. */
  Eigen::Matrix3d covariance() const { return covariance_.topLeftCorner<3, 3>(); }
  /** Estimated errors of the camera's tilt, rad. */
  Eigen::Vector2d tilt() const { return state_.tail<2>(); }

 private:
  /** One measured number: its derivative by the state, by the tilt, what is left of it, and the
   * variance of its own noise. */
  struct Row {
    Eigen::Matrix<double, 1, 5> jacobian;
    double innovation = 0;
    double variance = 0;
  };

  /** Where an observed point lies along a direction of the field, relative to a target. */
  Row make_row(const CameraPlace& camera, const Eigen::Vector2d& point,
               const Eigen::Vector2d& direction, double target, double extra_variance) const;
  /** Squared Mahalanobis distance of two rows. */
  double distance(const std::vector<Row>& rows) const;
  std::vector<Row> match_line(const CameraPlace& camera, const FieldLine& line) const;
  std::vector<Row> match_point(const CameraPlace& camera, const Eigen::Vector2d& point,
                               const Eigen::Vector2d& target, double radial_variance,
                               double tangential_variance) const;
  bool is_on_circle(const FieldLine& line) const;
  void apply(const std::vector<Row>& rows);

  const FieldModel* field_;
  State state_ = State::Zero();
  Covariance covariance_ = Covariance::Zero();
};

}  // namespace nao::vision
