#pragma once

#include <Eigen/Geometry>
#include <opencv2/core.hpp>
#include <optional>

#include "daemons/vision/vision_core.h"

namespace nao::vision {

/** A field drawn by casting one ray for each of 2x2 parts of a pixel: carpet with lines, a ball,
 * and a grey background. It shares no code with the detectors. */
struct DrawnField {
  CameraCalibration calibration = CameraCalibration::guess(640, 480);
  /** Camera in the heading frame. */
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  /** In the heading frame, m. */
  std::optional<Eigen::Vector2d> ball;
  std::optional<Eigen::Vector2d> circle;
  /** Lines of 5 cm width: from x1, y1 to x2, y2. */
  std::vector<Eigen::Vector4d> lines;
  /** Factor on the brightness of what lies left of the robot, y > 0: a hard shadow. */
  double shadow = 1;

  /** Camera 0.5 m above the ground, pitched downwards by an angle, rad. */
  explicit DrawnField(double pitch);

  /** The whole input for the core; with noise of a deviation of 3 levels. */
  VisionInput input() const;

 private:
  Eigen::Vector3d color(const Eigen::Vector3d& direction) const;
  Eigen::Vector3d ground_color(const Eigen::Vector2d& point) const;
};

}  // namespace nao::vision
