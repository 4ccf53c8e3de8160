#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "daemons/vision/detection.h"
#include "daemons/vision/field_model.h"
#include "daemons/vision/vision_parameters.h"
#include "kinematics/pose2.h"

namespace nao::vision {

/** Where the camera was, as far as positions on the ground depend on it. */
struct CameraPlace {
  /** In the heading frame H, m; z is the height over the ground. */
  Eigen::Vector3d position = Eigen::Vector3d::UnitZ();
  /** Angle of a pixel in the middle of the image, rad. */
  double pixel_angle = 0.002;
};

/** What one image shows of the field, as points on the ground in the heading frame H, m. */
struct FieldObservation {
  Pose2 heading_in_odometry;
  CameraPlace camera;
  std::vector<FieldLine> lines;
  /** Center of the center circle. */
  std::optional<Eigen::Vector2d> circle;
  std::vector<Eigen::Vector2d> posts;
  /** Heading in H of the robot that saw this, rad: the axes about which its camera was tilted. */
  double seen_heading = 0;

  /** Sum of the lengths of the lines, m. */
  double length() const;
  /** Derivative of the position of a ground point by small rotations of the camera about the x and
   * y axes of the robot that saw it, m/rad. */
  Eigen::Matrix2d tilt_jacobian(const Eigen::Vector2d& point) const;
  /** The same observation with the camera turned by such rotations, rad. */
  FieldObservation tilted(const Eigen::Vector2d& tilt) const;
  /** The same observation as seen from where the odometry is `heading_in_odometry`. */
  FieldObservation moved_to(const Pose2& heading_in_odometry) const;
};

/** The detections of an image that serve localisation: lines, circle and posts that are near
 * enough. Crossings are made of lines, and would count them twice. */
FieldObservation observe_field(const Detections& detections, const CameraPlace& camera,
                               const Pose2& heading_in_odometry,
                               const VisionParameters::FieldObservation& parameters);

/** Derivative of a ground point (m, in H) by small rotations (rad) of the camera about the x and y
 * axes of H.
 *
 * With the point P relative to the camera's ground point and the camera's height h, the rotated ray
 * meets the ground at P' = (P + (-b h, a h)) h / (h - a P_y + b P_x); here its linear part. */
Eigen::Matrix2d tilt_jacobian(const CameraPlace& camera, const Eigen::Vector2d& point);

/** Moves the positions of balls and robots to where they are if the camera is turned by small
 * rotations about the x and y axes of H, rad. */
void correct_by_tilt(const CameraPlace& camera, const Eigen::Vector2d& tilt,
                     Detections& detections);

}  // namespace nao::vision
