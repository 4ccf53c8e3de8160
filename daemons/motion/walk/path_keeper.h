#pragma once

#include <Eigen/Core>
#include <algorithm>

#include "kinematics/pose2.h"

namespace nao::motion {

/** Keeps a walk on the path that its velocity means.
 *
 * Feet slip, land early and give way to pushes. The path is where the body would be by now, had
 * every step done what was wished; the way from the body to it, as odometry sees it, is walked off
 * in the steps that follow. What lies too far behind is given up, so that nobody who holds a robot
 * or pushes it sees it run afterwards. */
class PathKeeper {
 public:
  /** Begins where the body is. @param body  In odometry, m and rad. */
  void reset(const Pose2& body) {
    path_ = body;
    error_.setZero();
  }

  /** The path goes on. @param velocity  Wished in the body's frame: m/s, m/s, rad/s. */
  void advance(const Eigen::Vector3d& velocity, double dt) {
    const double turn = velocity.z() * dt;
    // Half the turn before the way: the chord of the arc, to second order.
    path_ = path_ *
            Pose2{Eigen::Rotation2Dd(turn / 2) * Eigen::Vector2d(velocity.head<2>() * dt), turn};
  }

  /** Looks at the body when a foot has landed.
   * @param body  In odometry. @param gain  Share of the error that is walked off in a second, 1/s.
   * @return Velocity to add, in the body's frame: m/s, m/s, rad/s. */
  Eigen::Vector3d correct(const Pose2& body, double gain) {
    const Eigen::Vector2d limit = Eigen::Vector2d::Constant(kFarthest);
    const Eigen::Vector2d behind =
        (body.inverse() * path_.position).cwiseMax(-limit).cwiseMin(limit);
    const double turned =
        std::clamp(wrapped(path_.heading - body.heading), -kFarthestTurn, kFarthestTurn);
    path_ = body * Pose2{behind, turned};
    // The two feet err in opposite directions; their mean counts.
    const Eigen::Vector3d now(behind.x(), behind.y(), turned);
    const Eigen::Vector3d mean = 0.5 * (now + error_);
    error_ = now;
    return gain * mean;
  }

 private:
  // m and rad: at a gain of 1/s a fifth of the greatest speed, and what a push of 1 N s shifts.
  static constexpr double kFarthest = 0.06;
  static constexpr double kFarthestTurn = 0.15;

  Pose2 path_;
  Eigen::Vector3d error_ = Eigen::Vector3d::Zero();
};

}  // namespace nao::motion
