#pragma once

#include <Eigen/Core>
#include <optional>

#include "daemons/vision/field_model.h"
#include "daemons/vision/field_observation.h"
#include "daemons/vision/vision_parameters.h"
#include "kinematics/pose2.h"

namespace nao::vision {

/** Extended Kalman filter of the pose on the field: x, y, m, heading, rad, and the error of the
 * camera's tilt about the x and y axes of the heading frame, rad: its slow part and its noise.
 *
 * The tilt's error (joint zeros, backlash, orientation of the torso) moves all points of an image
 * together, most those far away; as part of the state it is estimated from them. Its slow part is a
 * first-order Gauss-Markov process, its noise is independent in every image.
 *
 * The landmarks of an image are used one after the other, those that fit best first: the tilt that
 * they imply for this image decides what the others can be. */
class PoseFilter {
 public:
  using State = Eigen::Matrix<double, 7, 1>;
  using Covariance = Eigen::Matrix<double, 7, 7>;

  /** @param field  Must outlive this. */
  PoseFilter(const FieldModel& field, const VisionParameters::PoseFilter& parameters);

  /** Starts at a pose. @param position_sigma  m. @param heading_sigma  rad.
   * @param tilt  Slow errors of the camera's tilt, as far as they are known, rad. */
  void start(const Pose2& pose, double position_sigma, double heading_sigma,
             const Eigen::Vector2d& tilt = Eigen::Vector2d::Zero());

  /** Moves the estimate to the next image by a step of the odometry, in the robot's frame.
   * @param dt  s. */
  void predict(const Pose2& step, double dt);
  /** Makes the estimate less certain, by standard deviations, m and rad. */
  void spread(double position_sigma, double heading_sigma);

  /** Takes the lines, circle and posts of an image that fit what the field has there. To be called
   * once after predict(). */
  void update(const FieldObservation& observation);

  Pose2 pose() const { return {state_.head<2>(), state_[2]}; }
  /** Covariance of x, y and heading. */
  Eigen::Matrix3d covariance() const { return covariance_.topLeftCorner<3, 3>(); }
  /** Estimated slow errors of the camera's tilt, rad. */
  Eigen::Vector2d tilt() const { return state_.segment<2>(3); }
  /** The same with the noise of the last image. */
  Eigen::Vector2d tilt_of_image() const { return state_.segment<2>(3) + state_.tail<2>(); }

 private:
  /** One measured number: its derivative by the state, what is left of it, and its variance. */
  struct Row {
    Eigen::Matrix<double, 1, 7> jacobian;
    double innovation = 0;
    double variance = 0;
  };
  /** The two numbers that a landmark measures, as rows. */
  struct Measurement {
    Measurement(const Row& a, const Row& b);

    Eigen::Matrix<double, 2, 7> jacobian;
    Eigen::Vector2d innovation;
    /** Covariance of the measurement's own noise. */
    Eigen::Matrix2d covariance;
  };
  /** Nothing if a landmark fits nothing, or several parts of the field. */
  using Match = std::optional<Measurement>;

  /** An observed point, corrected by the estimated tilt, on the field. */
  Eigen::Vector2d on_field(const CameraPlace& camera, const Eigen::Vector2d& point) const;
  /** Where an observed point lies along a direction of the field, relative to a target. */
  Row make_row(const CameraPlace& camera, const Eigen::Vector2d& point,
               const Eigen::Vector2d& direction, double target, double extra_variance) const;
  /** Covariance of the innovation. */
  Eigen::Matrix2d innovation_covariance(const Measurement& measurement) const;
  /** Squared Mahalanobis distance. */
  double distance(const Measurement& measurement) const;
  Match match_line(const CameraPlace& camera, const FieldLine& line) const;
  /** The line as a chord of the center circle; none if it is too long. */
  Match match_chord(const CameraPlace& camera, const FieldLine& line) const;
  Match match_point(const CameraPlace& camera, const Eigen::Vector2d& point,
                    const Eigen::Vector2d& target, double radial_variance,
                    double tangential_variance) const;
  Match match_circle(const CameraPlace& camera, const Eigen::Vector2d& circle) const;
  Match match_post(const CameraPlace& camera, const Eigen::Vector2d& post) const;
  void apply(const Measurement& measurement);

  const FieldModel* field_;
  VisionParameters::PoseFilter parameters_;
  State state_ = State::Zero();
  Covariance covariance_ = Covariance::Zero();
};

}  // namespace nao::vision
