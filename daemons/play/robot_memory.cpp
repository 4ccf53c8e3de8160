#include "daemons/play/robot_memory.h"

#include <algorithm>
#include <cmath>

namespace nao::play {
namespace {

using Eigen::Vector2d;

}  // namespace

void RobotMemory::add(const std::vector<Vector2d>& robots, double time) {
  for (const Vector2d& robot : robots) {
    const auto known = std::find_if(seen_.begin(), seen_.end(), [&](const Seen& seen) {
      return (seen.position - robot).norm() < parameters_.same_robot;
    });
    if (known != seen_.end()) {
      *known = {robot, time};
    } else {
      seen_.push_back({robot, time});
    }
  }
}

void RobotMemory::forget(double time) {
  std::erase_if(seen_, [&](const Seen& seen) {
    return std::abs(time - seen.time) > parameters_.forget_robot_after;
  });
}

std::vector<Vector2d> RobotMemory::positions() const {
  std::vector<Vector2d> result;
  for (const Seen& seen : seen_) result.push_back(seen.position);
  return result;
}

WalkCommand keep_clear(WalkCommand walk, const std::vector<Vector2d>& robots, const Pose2& feet,
                       const PlayParameters::RobotMemory& parameters) {
  for (const Vector2d& robot : robots) {
    const Vector2d way = feet.inverse() * robot;
    const double distance = way.norm();
    if (distance > parameters.free_distance || distance < 1e-3) continue;
    const Vector2d towards = way / distance;
    const Vector2d velocity(walk.vx, walk.vy);
    const double approach = velocity.dot(towards);
    const double allowed =
        parameters.approach_gain * std::max(0.0, distance - parameters.stop_distance);
    if (approach <= allowed) continue;
    // The robot passes it at right angles, on the side to which the rest of the velocity points.
    const Vector2d left(-towards.y(), towards.x());
    const double side = velocity.dot(left) >= 0 ? 1 : -1;
    const double aside = side * std::max(std::abs(velocity.dot(left)), parameters.pass_speed);
    const Vector2d result = allowed * towards + aside * left;
    walk.vx = result.x();
    walk.vy = result.y();
  }
  return walk;
}

}  // namespace nao::play
