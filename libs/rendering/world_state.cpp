#include "rendering/world_state.h"

#include <cmath>

namespace nao {
namespace {

Eigen::Isometry3d interpolated(const Eigen::Isometry3d& from, const Eigen::Isometry3d& to,
                               double fraction) {
  // Rotation from `from` to `to`, as axis and angle; a fraction of the angle is spherical linear
  // interpolation.
  const Eigen::AngleAxisd rotation(Eigen::Matrix3d(from.linear().transpose() * to.linear()));
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() =
      from.linear() * Eigen::AngleAxisd(fraction * rotation.angle(), rotation.axis()).matrix();
  pose.translation() = from.translation() + fraction * (to.translation() - from.translation());
  return pose;
}

}  // namespace

WorldState interpolated(const WorldState& from, const WorldState& to, double fraction) {
  WorldState world = to;
  world.utime = from.utime + std::llround(fraction * static_cast<double>(to.utime - from.utime));
  for (RobotPose& robot : world.robots) {
    const RobotPose* start = from.find_robot(robot.name);
    // A robot that has just appeared has no earlier pose: it is shown where it is now.
    if (start == nullptr || start->position.size() != robot.position.size()) continue;
    robot.pose_torso_in_world =
        interpolated(start->pose_torso_in_world, robot.pose_torso_in_world, fraction);
    for (size_t i = 0; i < robot.position.size(); ++i) {
      robot.position[i] = start->position[i] + fraction * (robot.position[i] - start->position[i]);
    }
  }
  if (from.pose_ball_in_world && to.pose_ball_in_world) {
    world.pose_ball_in_world =
        interpolated(*from.pose_ball_in_world, *to.pose_ball_in_world, fraction);
  }
  return world;
}

}  // namespace nao
