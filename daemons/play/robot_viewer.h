#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "daemons/play/head_control.h"
#include "daemons/play/situation.h"
#include "kinematics/kinematics.h"
#include "robot_model/robot_model.h"

namespace nao::play {

/** Computes where feet and cameras are from the torso's pose and the joints; and holds what
 * behaviors need from the robot's files. */
class RobotViewer {
 public:
  /** @param model  Must outlive this. */
  explicit RobotViewer(const RobotModel& model);

  /** @param torso_in_odometry  The torso's pose in the odometry frame.
   * @param position  Angles of all motors, rad, in motor order. */
  RobotView look(const Eigen::Isometry3d& torso_in_odometry, const std::vector<double>& position);

  const HeadLimits& head_limits() const { return head_limits_; }
  /** Yaw and pitch; empty where there is none. */
  const std::vector<std::string>& head_joints() const { return head_joints_; }

 private:
  const RobotModel& model_;
  Kinematics kinematics_;
  int yaw_motor_ = -1;
  int pitch_motor_ = -1;
  HeadLimits head_limits_;
  std::vector<std::string> head_joints_;
};

/** Reads what never changes: walk limits, actions, kick (data/robots/NAME/actions/kick.yaml),
 * parameters, and the field of a scene.
 * @throws ConfigError  if the scene has no field. */
PlayConstants load_constants(const RobotModel& model, const std::string& scene);

}  // namespace nao::play
