#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace nao {

class RobotModel;

/** A light that is lit. */
struct LitLight {
  /** As in the robot's lights.yaml. */
  std::string name;
  /** Red, green, blue, 0 to 1, as displayed (gamma-encoded). */
  Eigen::Vector3f rgb = Eigen::Vector3f::Zero();

  bool operator==(const LitLight&) const = default;
};

/** State of one robot, as far as it is visible. */
struct RobotPose {
  std::string name;
  Eigen::Isometry3d pose_torso_in_world = Eigen::Isometry3d::Identity();
  /** rad (hands: opening), (num_motors), motor order. */
  std::vector<double> position;
  std::vector<LitLight> lights{};
  /** Nothing: that of the program which draws it, see RobotModels. */
  std::shared_ptr<const RobotModel> model{};
  /** Team (0 or 1) and number on the shirt; 0 and 0: it wears none. */
  int team = 0;
  int number = 0;
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

/** Whether two states look the same from everywhere: all but their times is equal, places and
 * angles to 1e-5 m and rad, a hundredth of a camera's pixel. */
bool looks_same(const WorldState& a, const WorldState& b);

/** Interpolates between two states, or extrapolates: positions linearly, orientations along the
 * shortest rotation. A robot that is in one of them only is as in `to`.
 * @param fraction  0 gives `from`, 1 gives `to`; values outside 0 to 1 extrapolate. */
WorldState interpolated(const WorldState& from, const WorldState& to, double fraction);

}  // namespace nao
