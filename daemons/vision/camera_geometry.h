#pragma once

#include <Eigen/Geometry>
#include <array>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

namespace nao::vision {

/** Intrinsics and lens distortion of an image, as in image_t. */
struct CameraCalibration {
  /** Focal lengths and principal point, pixels. */
  double fx = 0;
  double fy = 0;
  double cx = 0;
  double cy = 0;
  /** k1 k2 p1 p2 k3 in OpenCV's order, no unit. */
  std::array<double, 5> distortion{};

  bool has_distortion() const { return distortion != std::array<double, 5>{}; }
  /** All numbers are finite, and the focal lengths above 0. */
  bool is_valid() const;
  /** Calibration for an image of an unknown camera: a field of view of 60.9 degrees, that of the
   * NAO V5's cameras (vendor's data sheet). */
  static CameraCalibration guess(int width, int height);
};

/** Standard deviations of what the projection to the ground depends on. */
struct ProjectionNoise {
  /** Deviation of a detection in the image, pixels. Chosen: typical edge accuracy at 640x480. */
  double pixel = 1.0;
  /** Deviation of the camera's orientation about each axis, rad. Chosen: 0.6 degrees, half of the
   * total backlash of a NAO's neck and hip joints. */
  double angle = 0.01;
  /** Deviation of the camera's height, m. */
  double height = 0.005;
};

/** A point on the ground in the heading frame H. */
struct GroundPoint {
  /** m. */
  Eigen::Vector2d position;
  /** m^2. */
  Eigen::Matrix2d covariance;
};

/** Projections between image, camera and ground.
 *
 * Camera axes: x along the view, y left, z up. "Ideal" pixels are those of the same camera without
 * distortion. */
class CameraGeometry {
 public:
  /** @param pose_camera_in_heading  Nothing: positions on the ground are unknown. */
  CameraGeometry(const CameraCalibration& calibration,
                 const std::optional<Eigen::Isometry3d>& pose_camera_in_heading,
                 const ProjectionNoise& noise = {});

  bool has_pose() const { return pose_.has_value(); }

  /** Ideal pixels of pixels of the image. */
  std::vector<cv::Point2f> undistorted(const std::vector<cv::Point2f>& pixels) const;
  cv::Point2f undistorted(const cv::Point2f& pixel) const;
  /** Pixel of the image of an ideal pixel. */
  cv::Point2f distorted(const cv::Point2f& ideal) const;

  /** Where the ray through an ideal pixel meets the plane z = height (m).
   * @return Nothing without a pose, or if the ray does not meet it within 30 m. */
  std::optional<Eigen::Vector2d> at_height(const cv::Point2f& ideal, double height) const;
  /** As at_height(), with the covariance by ProjectionNoise. */
  std::optional<GroundPoint> locate(const cv::Point2f& ideal, double height = 0) const;

  /** Pixel of the image that shows a point (m, in H). Nothing without pose or behind the camera. */
  std::optional<cv::Point2f> project(const Eigen::Vector3d& point_in_heading) const;

  /** Radius in the image of a sphere of the given radius (m) that lies on the ground and is
   * centered in a pixel; nothing if none can be there. */
  std::optional<double> sphere_radius_px(const cv::Point2f& pixel, double radius) const;

  /** Row of the horizon in a column, pixels; nothing without a pose. */
  std::optional<double> horizon_row(double column) const;

 private:
  /** The lens shows a direction whose tangent to the view has this square. */
  bool is_in_lens(double r2) const;
  Eigen::Vector3d ray(const cv::Point2f& ideal) const;
  static std::optional<Eigen::Vector2d> intersect(const Eigen::Isometry3d& pose,
                                                  const Eigen::Vector3d& ray, double height);

  CameraCalibration calibration_;
  std::optional<Eigen::Isometry3d> pose_;
  ProjectionNoise noise_;
};

}  // namespace nao::vision
