#include "daemons/motion/transitions/body_state.h"

#include <cmath>
#include <limits>

#include "daemons/motion/generators/posture_motion.h"
#include "daemons/motion/transitions/transition_graph.h"

namespace nao::motion {
std::string find_body_state(const RobotModel& model, const RobotState& state, double lying_tilt) {
  if (is_lying(state, lying_tilt)) {
    // The side follows from the torso axis that is nearest to vertical: x forward, y to the left.
    const Eigen::Vector3d up = state.torso_in_odometry.linear().row(2);
    if (std::abs(up.y()) > std::abs(up.x())) return up.y() < 0 ? "left" : "right";
    return up.x() < 0 ? "belly" : "back";
  }
  // Upright above a seat's height: on feet, or unknown in the air. Below it the robot sits, in the
  // sitting posture whose joint angles are nearest.
  if (is_above_seat(model, state)) {
    return state.left_foot_carries || state.right_foot_carries ? kOnFeet : "";
  }
  std::string nearest;
  double least = std::numeric_limits<double>::infinity();
  for (const Posture& posture : model.postures()) {
    if (posture.family != "sitting") continue;
    const double deviation = deviation_from(posture, state.joint_position).angle;
    if (deviation >= least) continue;
    least = deviation;
    nearest = state_of(posture);
  }
  return nearest;
}

bool is_lying(const RobotState& state, double lying_tilt) {
  // The cosine of the tilt is the z component of the torso's z axis in the odometry frame.
  return state.torso_in_odometry.linear()(2, 2) < std::cos(lying_tilt);
}

bool is_above_seat(const RobotModel& model, const RobotState& state) {
  return state.torso_in_odometry.translation().z() > model.references().heights.on_feet;
}

bool is_sitting(const RobotModel& model, const std::string& body_state) {
  const Posture* posture = model.find_posture(body_state);
  return posture != nullptr && posture->family == "sitting";
}

const Posture* find_present_posture(const RobotModel& model, const std::vector<double>& position,
                                    const RobotState& state, const MotionOptions& options) {
  // Angles alone do not tell a posture: a lying robot may have those of a standing one.
  for (const Posture& posture : model.postures()) {
    if (deviation_from(posture, position).angle >= options.tolerance_of(posture)) continue;
    if (state_of(posture) == find_body_state(model, state, options.lying_tilt)) return &posture;
  }
  return nullptr;
}

}  // namespace nao::motion
