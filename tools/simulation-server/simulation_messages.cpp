#include "tools/simulation-server/simulation_messages.h"

#include <limits>

namespace nao::simulation_server {

namespace protocol = naoremote::simulation;

namespace {

using Numbers = google::protobuf::RepeatedField<double>;

template <class Values>
void write_numbers(const Values& values, Numbers& numbers) {
  numbers.Clear();
  for (const double value : values) numbers.Add(value);
}

void write_quaternion(const Eigen::Quaterniond& q, Numbers& numbers) {
  write_numbers(Eigen::Vector4d(q.w(), q.x(), q.y(), q.z()), numbers);
}

ActionCommand to_core(const protocol::Command::Action& action) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  return {action.action(), action.has_ball_x() ? action.ball_x() : nan,
          action.has_ball_y() ? action.ball_y() : nan,
          action.has_strength() ? action.strength() : nan};
}

JointChangeCommand to_core(const protocol::Command::ChangeJoints& change) {
  JointChangeCommand command;
  command.joint_names = {change.joint_names().begin(), change.joint_names().end()};
  command.joint_position = {change.joint_position().begin(), change.joint_position().end()};
  command.is_relative = change.is_relative();
  command.speed = change.speed();
  command.allow_tipping = change.allow_tipping();
  return command;
}

}  // namespace

void write_description(const RobotModel& model, protocol::Description& description) {
  for (int motor = 0; motor < model.num_motors(); ++motor) {
    const Joint& joint = model.motor_joint(motor);
    protocol::Joint& written = *description.add_joints();
    written.set_name(joint.name);
    written.set_lower(joint.lower);
    written.set_upper(joint.upper);
    written.set_max_velocity(joint.max_velocity);
  }
  for (const Posture& posture : model.postures()) description.add_postures(posture.name);
  for (const Action& action : model.actions()) description.add_actions(action.name);
  for (const int link : model.foot_sensors()) {
    description.add_foot_sensors(model.links()[link].name);
  }
  const WalkLimits& limits = model.walk_limits();
  description.set_max_vx(limits.forward);
  description.set_min_vx(-limits.backward);
  description.set_max_vy(limits.sideways);
  description.set_max_wz(limits.turning);
}

int64_t send_command(const protocol::Command& command, ClosedLoop& loop) {
  switch (command.command_case()) {
    case protocol::Command::kWalk: {
      const auto& walk = command.walk();
      const Eigen::Vector3d velocity(walk.vx(), walk.vy(), walk.wz());
      const int64_t id = loop.hold_walk(velocity);
      if (velocity.isZero(0)) loop.release_walk();
      return id;
    }
    case protocol::Command::kMoveTo: {
      const auto& goal = command.move_to();
      loop.release_walk(false);
      return loop.send({"", 0, MoveToCommand{goal.x(), goal.y(), goal.theta()}});
    }
    case protocol::Command::kPosture:
      loop.release_walk(false);
      return loop.send_posture(command.posture().posture(), command.posture().speed());
    case protocol::Command::kChangeJoints:
      return loop.send({"", 0, to_core(command.change_joints())});
    case protocol::Command::kAction:
      loop.release_walk(false);
      return loop.send({"", 0, to_core(command.action())});
    case protocol::Command::kStop:
    case protocol::Command::COMMAND_NOT_SET:
      break;
  }
  loop.release_walk(false);
  return loop.send({"", 0, StopCommand{}});
}

void write_state(ClosedLoop& loop, protocol::State& state) {
  const sim::SensorReadings& sensors = loop.world().sensors(0);
  state.set_time(loop.time());
  state.set_period(loop.period());
  write_numbers(sensors.position, *state.mutable_joint_position());
  write_numbers(sensors.velocity, *state.mutable_joint_velocity());
  write_numbers(sensors.torque, *state.mutable_joint_torque());
  write_numbers(loop.world().targets(0).position, *state.mutable_joint_target());
  write_numbers(Eigen::VectorXd::Map(loop.targets().data(), loop.model().num_motors()),
                *state.mutable_motion_target());
  write_numbers(sensors.accelerometer, *state.mutable_accelerometer());
  write_numbers(sensors.gyroscope, *state.mutable_gyroscope());
  write_quaternion(sensors.orientation, *state.mutable_orientation_torso_in_world());
  write_numbers(sensors.foot_force, *state.mutable_foot_force());
  const motion::RobotState& estimate = loop.estimate();
  write_numbers(Eigen::Vector3d(estimate.torso_in_odometry.translation()),
                *state.mutable_torso_position());
  write_quaternion(Eigen::Quaterniond(estimate.torso_in_odometry.linear()),
                   *state.mutable_torso_orientation());
  write_numbers(estimate.velocity_torso_in_heading, *state.mutable_velocity_torso_in_heading());
  state.set_left_foot_carries(estimate.left_foot_carries);
  state.set_right_foot_carries(estimate.right_foot_carries);
  const motion::MotionState& motion = loop.core().motion_state();
  state.set_mode(static_cast<uint32_t>(motion.mode));
  state.set_posture(motion.posture);
}

void write_result(const CommandResult& result, protocol::CommandResult& message) {
  message.set_command_id(result.id);
  message.set_status(static_cast<uint32_t>(result.status));
  message.set_reason_code(result.reason.code);
  message.set_reason(to_sentence(result.reason));
}

void write_truth(ClosedLoop& loop, protocol::Truth& truth) {
  const Eigen::Isometry3d torso = loop.torso_in_world();
  write_numbers(Eigen::Vector3d(torso.translation()), *truth.mutable_torso_position());
  write_quaternion(Eigen::Quaterniond(torso.linear()), *truth.mutable_torso_orientation());
  write_numbers(loop.world().robot(0).motor_position(), *truth.mutable_joint_position());
  if (loop.world().has_ball()) {
    write_numbers(loop.world().ball().position, *truth.mutable_ball_position());
  }
}

}  // namespace nao::simulation_server
