#include "rendering/decode_state.h"

#include <cmath>
#include <naolcm/world_truth_t.hpp>

#include "common/error.h"
#include "messages/named_joints.h"

namespace nao {
namespace {

/** Allowed deviation of a quaternion's norm from 1. Chosen: far above rounding errors, small enough
 * that a damaged message is rejected. */
constexpr double kNormTolerance = 1e-3;

}  // namespace

std::vector<double> decode_positions(const RobotModel& model, const std::vector<std::string>& names,
                                     const std::vector<double>& position) {
  std::vector<double> decoded(model.num_motors(), 0.0);
  const auto fault = read_named_joints(model.motor_names(), names,
                                       {{"position", position, decoded}}, JointCoverage::kSubset);
  if (fault) throw Error(to_sentence(*fault));
  return decoded;
}

Eigen::Isometry3d decode_pose(const double (&position)[3], const double (&quaternion)[4]) {
  const Eigen::Quaterniond rotation(quaternion[0], quaternion[1], quaternion[2], quaternion[3]);
  const Eigen::Vector3d translation(position[0], position[1], position[2]);
  if (!translation.allFinite()) throw Error("a position is not finite");
  if (!(std::abs(rotation.norm() - 1) < kNormTolerance)) {
    throw Error("a quaternion has the norm " + std::to_string(rotation.norm()) + " instead of 1");
  };
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = rotation.normalized().toRotationMatrix();
  pose.translation() = translation;
  return pose;
}

WorldState decode_truth(const RobotModel& model, const naolcm::world_truth_t& truth) {
  WorldState state;
  state.utime = truth.utime;
  state.scene = truth.scene;
  for (const naolcm::robot_truth_t& robot : truth.robots) {
    state.robots.push_back(
        {robot.robot, decode_pose(robot.position_torso_in_world, robot.orientation_torso_in_world),
         decode_positions(model, robot.joint_names, robot.joint_position)});
  }
  if (truth.has_ball != 0) {
    state.pose_ball_in_world =
        decode_pose(truth.position_ball_in_world, truth.orientation_ball_in_world);
  }
  return state;
}

}  // namespace nao
