#include "daemons/motion/transitions/body_state.h"

#include <cmath>
#include <limits>

#include "daemons/motion/generators/posture_motion.h"
#include "daemons/motion/transitions/transition_graph.h"

namespace nao::motion {
namespace {

// Torso height from which on an upright robot is on its feet and not on its seat, m: a crouch has
// 0.229, a seat 0.12.
constexpr double kLeastStandingHeight = 0.19;

}  // namespace

std::string find_body_state(const RobotModel& model, const RobotState& state, double lying_tilt) {
  const Eigen::Vector3d up = state.torso_in_odometry.linear().row(2);
  const bool lies = up.z() < std::cos(lying_tilt);
  if (lies) {
    if (std::abs(up.y()) > std::abs(up.x())) return up.y() < 0 ? "left" : "right";
    return up.x() < 0 ? "belly" : "back";
  }
  if (state.torso_in_odometry.translation().z() > kLeastStandingHeight) {
    return state.left_foot_carries || state.right_foot_carries ? "on-feet" : "";
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

}  // namespace nao::motion
