#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace nao {

/** One robot as a picture needs it. */
struct RobotPose {
  std::string name;
  Eigen::Isometry3d pose_torso_in_world = Eigen::Isometry3d::Identity();
  /** rad (hands: opening), (num_motors), motor order. */
  std::vector<double> position;
};

/** The world at one instant as a picture needs it. */
struct WorldState {
  /** Robot time, microseconds. */
  int64_t utime = 0;
  /** Name of the scene file. */
  std::string scene;
  std::vector<RobotPose> robots;
  /** Ball's centre, if there is a ball. */
  std::optional<Eigen::Isometry3d> pose_ball_in_world;

  /** @return nullptr if there is no robot of that name. */
  const RobotPose* find_robot(const std::string& name) const {
    for (const RobotPose& robot : robots) {
      if (robot.name == name) return &robot;
    }
    return nullptr;
  }
};

/** The world on its way from one state to another, or on before or beyond: positions along a line,
 * orientations along the shortest turn. A robot that only one of them knows is as `to` has it.
 * @param share  0 gives `from`, 1 gives `to`. */
WorldState interpolated(const WorldState& from, const WorldState& to, double share);

}  // namespace nao
