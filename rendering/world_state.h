#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace nao {

/** State of one robot, as far as it is visible. */
struct RobotPose {
  std::string name;
  Eigen::Isometry3d pose_torso_in_world = Eigen::Isometry3d::Identity();
  /** rad (hands: opening), (num_motors), motor order. */
  std::vector<double> position;
};

/** State of the world at one time, as far as it is visible. */
struct WorldState {
  /** Robot time, microseconds. */
  int64_t utime = 0;
  /** Name of the scene file. */
  std::string scene;
  std::vector<RobotPose> robots;
  /** Pose of the ball about its center, if there is a ball. */
  std::optional<Eigen::Isometry3d> pose_ball_in_world;

  /** @return nullptr if there is no robot of that name. */
  const RobotPose* find_robot(const std::string& name) const {
    for (const RobotPose& robot : robots) {
      if (robot.name == name) return &robot;
    }
    return nullptr;
  }
};

/** Interpolates between two states, or extrapolates: positions linearly, orientations along the
 * shortest rotation. A robot that is in one of them only is as in `to`.
 * @param fraction  0 gives `from`, 1 gives `to`; values outside 0 to 1 extrapolate. */
WorldState interpolated(const WorldState& from, const WorldState& to, double fraction);

}  // namespace nao
