#include "daemons/play/head_control.h"

#include <algorithm>
#include <cmath>

namespace nao::play {
namespace {

/** Height of a ball's center, m: the target of a gaze is slightly above the ground. */
constexpr double kHeight = 0.05;

}  // namespace

HeadTarget HeadControl::turn_to(double bearing, double depression, const CameraView& camera,
                                const RobotView& robot) const {
  const double yaw = robot.head_yaw + wrapped(bearing - camera.bearing);
  const double pitch = robot.head_pitch + depression - camera.depression;
  return {std::clamp(yaw, limits_.least_yaw, limits_.greatest_yaw),
          std::clamp(pitch, limits_.least_pitch, limits_.greatest_pitch), camera.name};
}

std::optional<HeadTarget> HeadControl::look(const Gaze& gaze, const RobotView& robot) {
  if (robot.cameras.empty()) return std::nullopt;
  if (!gaze.point) {
    camera_ = std::min(gaze.camera, robot.cameras.size() - 1);
    return turn_to(gaze.bearing, gaze.depression, robot.cameras[camera_], robot);
  }
  const Eigen::Vector2d point = robot.feet_in_odometry.inverse() * *gaze.point;
  std::optional<HeadTarget> best;
  double least = 0;
  size_t best_camera = 0;
  for (size_t i = 0; i < robot.cameras.size(); ++i) {
    const CameraView& camera = robot.cameras[i];
    const Eigen::Vector2d way = point - camera.position_in_feet.head<2>();
    const double depression = std::atan2(camera.position_in_feet.z() - kHeight, way.norm());
    // A point below the camera has no bearing.
    const double bearing = way.norm() > 0.03 ? std::atan2(way.y(), way.x()) : 0;
    const HeadTarget target = turn_to(bearing, depression, camera, robot);
    const double missed =
        std::abs(robot.head_pitch + depression - camera.depression - target.pitch);
    const double cost = missed + parameters_.pitch_cost * std::abs(target.pitch) -
                        (i == camera_ ? parameters_.hysteresis : 0);
    if (best && cost >= least) continue;
    best = target;
    least = cost;
    best_camera = i;
  }
  camera_ = best_camera;
  return best;
}

}  // namespace nao::play
