#include "daemons/motion/walk/whole_body_controller.h"

#include "daemons/motion/walk/foot_loads.h"
#include "daemons/motion/walk/orientation_feedback.h"

namespace nao::motion {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using Transition = BodyCommand::Transition;

/** Fraction of the transition from the pose of the start to the walk's. */
double lowered(const BodyCommand& command) {
  return command.transition == Transition::kFromStart ? command.walk_fraction : 1;
}

}  // namespace

WholeBodyController::WholeBodyController(const RobotModel& model, const Gait& gait,
                                         const Posture& end_posture)
    : gait_(&gait),
      mass_(model.total_mass()),
      end_posture_(&end_posture),
      pose_(model, gait),
      feedforward_(model) {}

void WholeBodyController::read_start(const std::vector<double>& position) {
  pose_.start(position);
  position_ = position;
}

void WholeBodyController::start(const BodyCommand& command) {
  // The targets that were sent last are not those of the commanded pose: they contain the load's
  // offsets. The difference is kept and fades, so that no joint jumps in the first tick.
  const std::vector<double> sent = position_;
  pose_.solve(command.reference, command.feet, command.feet.swing_sole(command.swing_offset),
              lowered(command), position_);
  velocity_.assign(position_.size(), 0.0);
  acceleration_.assign(position_.size(), 0.0);
  start_offset_.assign(position_.size(), 0.0);
  for (size_t i = 0; i < position_.size(); ++i) start_offset_[i] = sent[i] - position_[i];
}

void WholeBodyController::update_pose(const BodyCommand& command, double dt) {
  std::vector<double> position = position_;
  pose_.solve(command.reference, command.feet, command.feet.swing_sole(command.swing_offset),
              lowered(command), position);
  // Velocity of the commanded angles by difference, rad/s, for the servo's losses; and
  // acceleration.
  for (size_t i = 0; i < position.size(); ++i) {
    const double velocity = (position[i] - position_[i]) / dt;
    acceleration_[i] = (velocity - velocity_[i]) / dt;
    velocity_[i] = velocity;
  }
  position_ = std::move(position);
  pose_.update_com(position_, dt);
}

std::vector<double> WholeBodyController::calc_torques(const BodyCommand& command,
                                                      const WalkObserver& measured) const {
  const Isometry3d torso =
      pose_.torso_in_support(command.reference, command.feet, lowered(command));
  const LoadPlan plan{command.reference.dcm_error(measured.com()), command.other_load_ratio,
                      command.is_double_support};
  // The world's vertical in the torso frame.
  const Vector3d up = torso.linear().transpose() * Vector3d::UnitZ();
  std::vector<double> torque = feedforward_.calc_torques(
      pose_.kinematics(), up,
      plan_foot_loads(*gait_, mass_, command.feet, command.reference, plan, torso));
  // Torques that accelerate the swing leg; the accelerations of the support leg are those of the
  // body and are part of the ground reaction.
  const double scale = command.is_double_support ? 0 : gait_->servo.inertia_scale;
  if (scale == 0) return torque;
  const Leg swing = command.feet.support_is_left() ? Leg::kRight : Leg::kLeft;
  for (const int motor : pose_.legs().motors(swing)) {
    torque[motor] += scale * feedforward_.inertia(motor) * acceleration_[motor];
  }
  return torque;
}

void WholeBodyController::step(const BodyCommand& command, const WalkObserver& measured, double dt,
                               JointTargets& targets) {
  update_pose(command, dt);
  const std::vector<double> torque = calc_torques(command, measured);
  const double walk = command.walk_fraction;
  std::vector<double> feedback(position_.size(), 0.0);
  add_orientation_feedback(gait_->orientation, pose_.legs(), measured,
                           command.feet.support_is_left(), command.is_double_support, walk,
                           feedback);
  // While the robot rises the angular velocity is damped to the end; while it is lowered feedback
  // fades in.
  const bool is_raising = command.transition == Transition::kToEnd;
  const double feedback_scale = is_raising ? 1 : walk;
  for (const int motor : pose_.motors()) {
    const double posture_offset =
        is_raising ? end_posture_->position[motor] - position_[motor] : start_offset_[motor];
    // Commanded angle; offset to the posture before or after; feedback; and feedforward: servo
    // lead, and the angle that the servo needs to carry load and losses.
    targets.position[motor] =
        position_[motor] + (1 - walk) * posture_offset + feedback_scale * feedback[motor] +
        walk * (gait_->servo.lead_time * velocity_[motor] +
                feedforward_.calc_offset(motor, gait_->servo.torque_scale * torque[motor],
                                         velocity_[motor], gait_->servo.velocity_scale));
  }
}

}  // namespace nao::motion
