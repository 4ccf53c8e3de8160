#include "daemons/head-camera/overview.h"

#include <cmath>

namespace nao::camera {
namespace {

/** Fields of view, rad: 4:3 without distortion. Chosen: wider ones make robots at the image's edges
 * lean outwards. */
constexpr double kHorizontalFov = 1.22;
const double kVerticalFov = 2 * std::atan(0.75 * std::tan(0.5 * kHorizontalFov));
/** Depression of the view, rad. Chosen: robots hide few others, and are not seen from above. */
constexpr double kDepression = 0.7;
/** Margin that is visible beyond the field's ends, m. */
constexpr double kMargin = 0.4;
/** Distance from robots without a field, m. */
constexpr double kDistance = 2.5;

/** A camera at a distance from a point that it looks at, along y of the world. */
Eigen::Isometry3d looking_at(const Eigen::Vector3d& point, double distance) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  // x of the camera along y of the world, then down.
  pose.linear() = (Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitZ()) *
                   Eigen::AngleAxisd(kDepression, Eigen::Vector3d::UnitY()))
                      .toRotationMatrix();
  pose.translation() = point - distance * pose.linear().col(0);
  return pose;
}

}  // namespace

CameraModel overview_camera() {
  CameraModel camera;
  camera.name = kOverviewCamera;
  camera.horizontal_fov = kHorizontalFov;
  camera.vertical_fov = kVerticalFov;
  return camera;
}

Eigen::Isometry3d overview_pose(const std::optional<FieldDimensions>& field,
                                const WorldState& world) {
  if (field) {
    // The near side line must fill the width of the image, in which it lies below the middle. Its
    // distance along the view determines that of the camera.
    const double along_view = (0.5 * field->length + kMargin) / std::tan(0.5 * kHorizontalFov);
    const double to_side_line = 0.5 * field->width * std::cos(kDepression);
    return looking_at(Eigen::Vector3d::Zero(), along_view + to_side_line);
  }
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const RobotPose& robot : world.robots) {
    middle += robot.pose_torso_in_world.translation() / static_cast<double>(world.robots.size());
  }
  return looking_at(middle, kDistance);
}

}  // namespace nao::camera
