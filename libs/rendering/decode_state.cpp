#include "rendering/decode_state.h"

#include <memory>
#include <naolcm/world_truth_t.hpp>
#include <utility>

#include "common/error.h"
#include "messages/named_joints.h"
#include "messages/pose_message.h"

namespace nao {
namespace {

std::vector<LitLight> decode_lights(const naolcm::robot_truth_t& robot) {
  std::vector<LitLight> lights;
  for (size_t i = 0; i < robot.light_names.size(); ++i) {
    const Eigen::Map<const Eigen::Vector3d> rgb(robot.light_rgb[i].data());
    // Written so that NaN fails, too; minCoeff() may skip one.
    if (!((rgb.array() >= 0).all() && (rgb.array() <= 1).all())) {
      throw MessageError("the color of the light " + robot.light_names[i] + " is outside [0, 1]");
    }
    if (rgb.maxCoeff() > 0) lights.push_back({robot.light_names[i], rgb.cast<float>()});
  }
  return lights;
}

}  // namespace

// Joints that are not listed stay at 0. Unknown names and numbers that are not finite are errors,
// which the bus counts.
std::vector<double> decode_positions(const RobotModel& model, const std::vector<std::string>& names,
                                     const std::vector<double>& position) {
  std::vector<double> decoded(model.num_motors(), 0.0);
  const auto fault = read_named_joints(model.motor_names(), names,
                                       {{"position", position, decoded}}, JointCoverage::kSubset);
  if (fault) throw MessageError(to_sentence(*fault));
  return decoded;
}

WorldState decode_truth(RobotModels& models, const naolcm::world_truth_t& truth) {
  WorldState state;
  state.utime = truth.utime;
  state.scene = truth.scene;
  for (const naolcm::robot_truth_t& robot : truth.robots) {
    std::shared_ptr<const RobotModel> model = models.find(robot.model);
    state.robots.push_back(
        {robot.robot, decode_pose(robot.position_torso_in_world, robot.orientation_torso_in_world),
         decode_positions(model ? *model : models.own(), robot.joint_names, robot.joint_position),
         decode_lights(robot), std::move(model), robot.team, robot.number});
  }
  if (truth.has_ball != 0) {
    state.pose_ball_in_world =
        decode_pose(truth.position_ball_in_world, truth.orientation_ball_in_world);
  }
  return state;
}

}  // namespace nao
