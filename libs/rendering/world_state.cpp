#include "rendering/world_state.h"

#include <algorithm>
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

// m and rad: what a standing robot moves by rounding is far less.
constexpr double kUnseen = 1e-5;

bool is_near(double a, double b) {
  return std::abs(a - b) < kUnseen;
}

bool is_near(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  return (a.matrix() - b.matrix()).cwiseAbs().maxCoeff() < kUnseen;
}

bool is_near(const RobotPose& a, const RobotPose& b) {
  return a.name == b.name && a.model == b.model && a.lights == b.lights && a.team == b.team &&
         a.number == b.number && is_near(a.pose_torso_in_world, b.pose_torso_in_world) &&
         std::equal(a.position.begin(), a.position.end(), b.position.begin(), b.position.end(),
                    [](double x, double y) { return is_near(x, y); });
}

}  // namespace

bool looks_same(const WorldState& a, const WorldState& b) {
  const auto &ball = a.pose_ball_in_world, &other = b.pose_ball_in_world;
  return a.scene == b.scene && ball.has_value() == other.has_value() &&
         (!ball || is_near(*ball, *other)) &&
         std::equal(a.robots.begin(), a.robots.end(), b.robots.begin(), b.robots.end(),
                    [](const RobotPose& x, const RobotPose& y) { return is_near(x, y); });
}

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
