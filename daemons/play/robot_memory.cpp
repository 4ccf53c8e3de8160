#include "daemons/play/robot_memory.h"

#include <algorithm>
#include <cmath>

namespace nao::play {
namespace {

using Eigen::Vector2d;

/** Time for which a robot is remembered after it was seen, s. Chosen: the head turns away for up to
 * 2 s. */
constexpr double kForgetRobotAfter = 2;
/** Distance within which two sightings are of one robot, m: an error of the camera's tilt of one
 * degree moves one at 2.5 m by 0.25 m. */
constexpr double kSameRobot = 0.4;
/** Distances between the middles of two robots, m: nearer than the first, no velocity towards the
 * other remains (shoulders are 0.3 m wide); beyond the second, all of it remains. */
constexpr double kStopDistance = 0.38;
constexpr double kFreeDistance = 0.8;
/** Allowed velocity towards a robot per m of distance beyond the first, 1/s: stops within a step.
 */
constexpr double kApproachGain = 0.6;
/** Sideways velocity with which a robot in the way is passed, m/s. */
constexpr double kPassSpeed = 0.08;

}  // namespace

void RobotMemory::add(const std::vector<Vector2d>& robots, double time) {
  for (const Vector2d& robot : robots) {
    const auto known = std::find_if(seen_.begin(), seen_.end(), [&](const Seen& seen) {
      return (seen.position - robot).norm() < kSameRobot;
    });
    if (known != seen_.end()) {
      *known = {robot, time};
    } else {
      seen_.push_back({robot, time});
    }
  }
}

void RobotMemory::forget(double time) {
  std::erase_if(seen_,
                [&](const Seen& seen) { return std::abs(time - seen.time) > kForgetRobotAfter; });
}

std::vector<Vector2d> RobotMemory::positions() const {
  std::vector<Vector2d> result;
  for (const Seen& seen : seen_) result.push_back(seen.position);
  return result;
}

WalkCommand keep_clear(WalkCommand walk, const std::vector<Vector2d>& robots, const Pose2& feet) {
  for (const Vector2d& robot : robots) {
    const Vector2d way = feet.inverse() * robot;
    const double distance = way.norm();
    if (distance > kFreeDistance || distance < 1e-3) continue;
    const Vector2d towards = way / distance;
    const Vector2d velocity(walk.vx, walk.vy);
    const double approach = velocity.dot(towards);
    const double allowed = kApproachGain * std::max(0.0, distance - kStopDistance);
    if (approach <= allowed) continue;
    // The robot passes it at right angles, on the side to which the rest of the velocity points.
    const Vector2d left(-towards.y(), towards.x());
    const double side = velocity.dot(left) >= 0 ? 1 : -1;
    const double aside = side * std::max(std::abs(velocity.dot(left)), kPassSpeed);
    const Vector2d result = allowed * towards + aside * left;
    walk.vx = result.x();
    walk.vy = result.y();
  }
  return walk;
}

}  // namespace nao::play
