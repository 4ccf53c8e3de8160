#include "daemons/vision/camera_geometry.h"

#include <cmath>

#include "common/constants.h"

namespace nao::vision {
namespace {

/** Points farther away than this are not on any field, m. */
constexpr double kReach = 30;
/** Points nearer to the plane of the camera are not projected, m. */
constexpr double kNear = 0.02;
/** Steps of numerical derivatives: pixels, rad and m. */
constexpr double kPixelStep = 0.25;
constexpr double kAngleStep = 1e-4;
constexpr double kHeightStep = 1e-4;
/** Steps by which an ideal pixel is found: as many as cv::undistortPoints() makes. */
constexpr int kUndistortionSteps = 5;

}  // namespace

// The limits reject damaged messages; no lens comes near them.
bool CameraCalibration::is_valid() const {
  for (const double coefficient : distortion) {
    if (!std::isfinite(coefficient) || std::abs(coefficient) > 10) return false;
  }
  return std::isfinite(fx) && std::isfinite(fy) && fx > 1 && fy > 1 && std::isfinite(cx) &&
         std::isfinite(cy);
}

CameraCalibration CameraCalibration::guess(int width, int height) {
  CameraCalibration calibration;
  calibration.fx = calibration.fy = 0.5 * width / std::tan(0.5 * 60.9 * kDegree);
  calibration.cx = 0.5 * (width - 1);
  calibration.cy = 0.5 * (height - 1);
  return calibration;
}

CameraGeometry::CameraGeometry(const CameraCalibration& calibration,
                               const std::optional<Eigen::Isometry3d>& pose_camera_in_heading,
                               const ProjectionNoise& noise)
    : calibration_(calibration), pose_(pose_camera_in_heading), noise_(noise) {}

std::vector<cv::Point2f> CameraGeometry::undistorted(const std::vector<cv::Point2f>& pixels) const {
  std::vector<cv::Point2f> ideal;
  ideal.reserve(pixels.size());
  for (const cv::Point2f& pixel : pixels) ideal.push_back(undistorted(pixel));
  return ideal;
}

// Fixed-point iteration of distorted(): from the distorted place the tangential shift is taken away
// and the rest is divided by the radial factor, both of the last estimate.
cv::Point2f CameraGeometry::undistorted(const cv::Point2f& pixel) const {
  const CameraCalibration& c = calibration_;
  if (!c.has_distortion()) return pixel;
  const auto& [k1, k2, p1, p2, k3] = c.distortion;
  const double distorted_x = (pixel.x - c.cx) / c.fx;
  const double distorted_y = (pixel.y - c.cy) / c.fy;
  double x = distorted_x;
  double y = distorted_y;
  for (int step = 0; step < kUndistortionSteps; ++step) {
    const double r2 = x * x + y * y;
    const double radial = 1 + r2 * (k1 + r2 * (k2 + r2 * k3));
    // Beyond what the lens shows the distorted place is the best estimate.
    if (radial <= 0) return pixel;
    const double shift_x = 2 * p1 * x * y + p2 * (r2 + 2 * x * x);
    const double shift_y = p1 * (r2 + 2 * y * y) + 2 * p2 * x * y;
    x = (distorted_x - shift_x) / radial;
    y = (distorted_y - shift_y) / radial;
  }
  return {static_cast<float>(c.cx + c.fx * x), static_cast<float>(c.cy + c.fy * y)};
}

cv::Point2f CameraGeometry::distorted(const cv::Point2f& ideal) const {
  const CameraCalibration& c = calibration_;
  const double x = (ideal.x - c.cx) / c.fx;
  const double y = (ideal.y - c.cy) / c.fy;
  // Brown-Conrady model in OpenCV's order of coefficients.
  const auto& [k1, k2, p1, p2, k3] = c.distortion;
  const double r2 = x * x + y * y;
  const double radial = 1 + r2 * (k1 + r2 * (k2 + r2 * k3));
  return {static_cast<float>(c.cx + c.fx * (x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x * x))),
          static_cast<float>(c.cy + c.fy * (y * radial + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y))};
}

// The distorted radius r (1 + k1 r^2 + k2 r^4 + k3 r^6) grows with r up to some angle; the model
// folds what lies farther out back into the image, where no lens shows it.
bool CameraGeometry::is_in_lens(double r2) const {
  const double k1 = calibration_.distortion[0];
  const double k2 = calibration_.distortion[1];
  const double k3 = calibration_.distortion[4];
  return 1 + r2 * (3 * k1 + r2 * (5 * k2 + r2 * 7 * k3)) > 0;
}

// In the camera's axes: x forward, y left, z up; not normalized.
Eigen::Vector3d CameraGeometry::ray(const cv::Point2f& ideal) const {
  return {1, -(ideal.x - calibration_.cx) / calibration_.fx,
          -(ideal.y - calibration_.cy) / calibration_.fy};
}

// Point at a height over the ground on the ray from the camera, in the heading frame H, m.
std::optional<Eigen::Vector2d> CameraGeometry::intersect(const Eigen::Isometry3d& pose,
                                                         const Eigen::Vector3d& ray,
                                                         double height) {
  const Eigen::Vector3d direction = pose.linear() * ray;
  const Eigen::Vector3d origin = pose.translation();
  // Parallel to the ground the division gives infinity, behind the camera a negative distance.
  const double distance = (height - origin.z()) / direction.z();
  if (!std::isfinite(distance) || distance <= 0) return std::nullopt;
  const Eigen::Vector2d point = origin.head<2>() + distance * direction.head<2>();
  if (point.norm() > kReach) return std::nullopt;
  return point;
}

std::optional<Eigen::Vector2d> CameraGeometry::at_height(const cv::Point2f& ideal,
                                                         double height) const {
  if (!pose_) return std::nullopt;
  return intersect(*pose_, ray(ideal), height);
}

std::optional<GroundPoint> CameraGeometry::locate(const cv::Point2f& ideal, double height) const {
  const auto position = at_height(ideal, height);
  if (!position) return std::nullopt;
  GroundPoint point{*position, Eigen::Matrix2d::Zero()};
  // First-order propagation of independent errors: sum of (sigma d/dx)(sigma d/dx)^T.
  const auto add = [&](const std::optional<Eigen::Vector2d>& moved, double step, double sigma) {
    // A moved ray that misses the ground contributes nothing.
    if (!moved) return;
    const Eigen::Vector2d slope = (*moved - *position) * (sigma / step);
    point.covariance += slope * slope.transpose();
  };
  const auto step = static_cast<float>(kPixelStep);
  // Downwards the ray meets the ground nearer to the camera.
  add(at_height(ideal + cv::Point2f(step, 0), height), kPixelStep, noise_.pixel);
  add(at_height(ideal + cv::Point2f(0, step), height), kPixelStep, noise_.pixel);
  for (int axis = 0; axis < 3; ++axis) {
    Eigen::Isometry3d turned = *pose_;
    turned.linear() = Eigen::AngleAxisd(kAngleStep, Eigen::Vector3d::Unit(axis)) * pose_->linear();
    add(intersect(turned, ray(ideal), height), kAngleStep, noise_.angle);
  }
  Eigen::Isometry3d lifted = *pose_;
  lifted.translation().z() += kHeightStep;
  add(intersect(lifted, ray(ideal), height), kHeightStep, noise_.height);
  return point;
}

std::optional<cv::Point2f> CameraGeometry::project(const Eigen::Vector3d& point_in_heading) const {
  if (!pose_) return std::nullopt;
  const Eigen::Vector3d point = pose_->inverse() * point_in_heading;
  if (point.x() < kNear) return std::nullopt;
  const CameraCalibration& c = calibration_;
  if (!is_in_lens(Eigen::Vector2d(point.y(), point.z()).squaredNorm() / (point.x() * point.x()))) {
    return std::nullopt;
  }
  return distorted({static_cast<float>(c.cx - c.fx * point.y() / point.x()),
                    static_cast<float>(c.cy - c.fy * point.z() / point.x())});
}

// The center of a ball on the ground is at the height of its radius; its image has about the radius
// f r / depth.
std::optional<double> CameraGeometry::sphere_radius_px(const cv::Point2f& pixel,
                                                       double radius) const {
  const cv::Point2f ideal = undistorted(pixel);
  const auto center = at_height(ideal, radius);
  if (!center) return std::nullopt;
  const Eigen::Vector3d point(center->x(), center->y(), radius);
  const double depth = (pose_->inverse() * point).x();
  if (depth < kNear) return std::nullopt;
  return calibration_.fx * radius / depth;
}

std::optional<double> CameraGeometry::horizon_row(double column) const {
  if (!pose_) return std::nullopt;
  // A ray (1, a, b) is level if its z in H, R(2,0) + a R(2,1) + b R(2,2), is 0.
  const Eigen::RowVector3d z = pose_->linear().row(2);
  // A camera that looks almost straight up or down has no usable horizon.
  if (std::abs(z.z()) < 0.1) return std::nullopt;
  const double a = -(column - calibration_.cx) / calibration_.fx;
  return calibration_.cy + calibration_.fy * (z.x() + a * z.y()) / z.z();
}

}  // namespace nao::vision
