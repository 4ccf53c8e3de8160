#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "kinematics/kinematics.h"
#include "kinematics/pose2.h"
#include "robot_model/robot_model.h"

namespace nao::vision {

/** The robot's estimated state at one time. */
struct RobotPosture {
  /** Robot time, microseconds. */
  int64_t utime = 0;
  Eigen::Isometry3d pose_torso_in_odometry = Eigen::Isometry3d::Identity();
  /** rad, motor order. */
  std::vector<double> position;
};

/** Where a camera was when it took an image. */
struct CameraPose {
  Eigen::Isometry3d pose_camera_in_heading = Eigen::Isometry3d::Identity();
  Pose2 heading_in_odometry;
  /** The torso is upright: the robot stands, walks or crouches. */
  bool is_upright = true;
};

/** The last second of the robot's states, interpolated at the times of images. */
class PoseHistory {
 public:
  /** @param model  Must outlive this. */
  explicit PoseHistory(const RobotModel& model) : model_(model), kinematics_(model) {}

  /** A time before the last one by more than 1 s restarts the history; other late states are
   * ignored. */
  void add(const RobotPosture& posture);

  /** Pose of a camera at a time.
   * @return Nothing if the robot has no such camera, or the time is not between two states at most
   * 0.1 s apart; up to 30 ms after the newest state that one is used. */
  std::optional<CameraPose> find(const std::string& camera, int64_t utime);

 private:
  Eigen::Isometry3d camera_in_odometry(const RobotPosture& posture, int link);

  const RobotModel& model_;
  Kinematics kinematics_;
  std::deque<RobotPosture> history_;
};

}  // namespace nao::vision
