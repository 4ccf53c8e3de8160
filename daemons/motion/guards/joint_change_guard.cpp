#include "daemons/motion/guards/joint_change_guard.h"

#include <cmath>
#include <string>

#include "common/constants.h"
#include "daemons/motion/generators/joint_change_motion.h"
#include "daemons/motion/transitions/body_state.h"

namespace nao::motion {
namespace {

// Weight of a joint above the hips, relative to a leg joint, when the joint that tips the robot is
// named: such a joint is named only if the change turns no leg joint. Chosen: smaller than the
// ratio of any two joint ranges.
constexpr double kUpperBodyWeight = 1e-3;

/** An angle as an argument, in degrees, rounded towards 0. @param angle  rad. */
std::string whole_degrees(double angle) {
  return std::to_string(std::lround(std::trunc(angle / kDegree)));
}

/** @param direction  Horizontal, torso frame: x forward, y to the left. */
Reason tipping_reason(const Eigen::Vector3d& direction, const std::string& joint,
                      const std::string& degrees) {
  if (std::abs(direction.x()) >= std::abs(direction.y())) {
    return direction.x() > 0 ? Reason("tipping-forward", {joint, degrees})
                             : Reason("tipping-backward", {joint, degrees});
  }
  return direction.y() > 0 ? Reason("tipping-left", {joint, degrees})
                           : Reason("tipping-right", {joint, degrees});
}

}  // namespace

std::optional<Reason> JointChangeGuard::find_danger(const JointChangeCommand& change,
                                                    const MotionContext& context,
                                                    const JointTargets& targets) {
  if (auto collision = find_self_collision(change, context, targets)) return collision;
  if (change.allow_tipping) return std::nullopt;
  const bool is_on_feet =
      find_body_state(*model_, context.state, context.options.lying_tilt) == kOnFeet;
  // A robot that lies or sits cannot tip over.
  return is_on_feet ? find_tipping(change, context, targets) : std::nullopt;
}

std::optional<Reason> JointChangeGuard::find_self_collision(const JointChangeCommand& change,
                                                            const MotionContext& context,
                                                            const JointTargets& targets) {
  JointChangeMotion motion(change);
  motion.start(context, targets);
  const std::vector<std::vector<double>> path = motion.calc_path(*model_);
  SelfCollision collision;
  const size_t last = collision_guard_.find_last_free(path, collision);
  // The whole path is free.
  if (last + 1 == path.size()) return std::nullopt;
  return Reason("self-collision",
                {model_->motor_joint(collision.motor).name, collision.link_a, collision.link_b,
                 whole_degrees(path[last][collision.motor] - path.front()[collision.motor])});
}

std::optional<Reason> JointChangeGuard::find_tipping(const JointChangeCommand& change,
                                                     const MotionContext& context,
                                                     const JointTargets& targets) {
  const std::vector<double>& from = targets.position;
  const std::vector<double> to = JointChangeMotion::calc_goal(*model_, change, from);
  const Eigen::Vector3d up_in_torso = context.state.torso_in_odometry.linear().row(2);
  Equilibrium tipping;
  const double safe_fraction = tipping_guard_.find_safe_fraction(from, to, up_in_torso, tipping);
  if (safe_fraction >= 1) return std::nullopt;
  const int motor = find_tipping_motor(change, context, from, to);
  return tipping_reason(tipping.tipping_direction, model_->motor_joint(motor).name,
                        whole_degrees(safe_fraction * (to[motor] - from[motor])));
}

int JointChangeGuard::find_tipping_motor(const JointChangeCommand& change,
                                         const MotionContext& context,
                                         const std::vector<double>& from,
                                         const std::vector<double>& to) const {
  const Eigen::Matrix3Xd left = context.kinematics.calc_angular_jacobian(model_->left_sole());
  const Eigen::Matrix3Xd right = context.kinematics.calc_angular_jacobian(model_->right_sole());
  int tipping_motor = -1;
  double largest = -1;
  // Finds the named joint that turns most; legs come before the upper body.
  for (const std::string& name : change.joint_names) {
    const int motor = model_->find_motor(name);
    const bool is_leg = !left.col(motor).isZero(0) || !right.col(motor).isZero(0);
    const double weight = std::abs(to[motor] - from[motor]) * (is_leg ? 1.0 : kUpperBodyWeight);
    if (weight <= largest) continue;
    largest = weight;
    tipping_motor = motor;
  }
  return tipping_motor;
}

}  // namespace nao::motion
