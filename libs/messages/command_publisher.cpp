#include "messages/command_publisher.h"

#include <limits>
#include <naolcm/action_command_t.hpp>
#include <naolcm/joint_change_command_t.hpp>
#include <naolcm/motion_state_t.hpp>
#include <naolcm/move_to_command_t.hpp>
#include <naolcm/posture_command_t.hpp>
#include <naolcm/stop_command_t.hpp>
#include <naolcm/walk_command_t.hpp>
#include <variant>

namespace nao {
namespace {

naolcm::walk_command_t to_message(const WalkCommand& walk) {
  naolcm::walk_command_t message{};
  message.vx = walk.vx;
  message.vy = walk.vy;
  message.wz = walk.wz;
  return message;
}

naolcm::move_to_command_t to_message(const MoveToCommand& goal) {
  naolcm::move_to_command_t message{};
  message.x = goal.x;
  message.y = goal.y;
  message.theta = goal.theta;
  return message;
}

naolcm::posture_command_t to_message(const PostureCommand& posture) {
  naolcm::posture_command_t message{};
  message.posture = posture.posture;
  message.speed = posture.speed;
  return message;
}

naolcm::joint_change_command_t to_message(const JointChangeCommand& change) {
  naolcm::joint_change_command_t message{};
  message.num_joints = static_cast<int32_t>(change.joint_names.size());
  message.joint_names = change.joint_names;
  message.joint_position = change.joint_position;
  message.joint_stiffness = change.joint_stiffness;
  // In the message, unlike in JointChangeCommand, every list has an entry for each joint.
  message.joint_stiffness.resize(change.joint_names.size(),
                                 std::numeric_limits<double>::quiet_NaN());
  message.is_relative = change.is_relative ? 1 : 0;
  message.speed = change.speed;
  message.allow_tipping = change.allow_tipping ? 1 : 0;
  return message;
}

naolcm::action_command_t to_message(const ActionCommand& action) {
  naolcm::action_command_t message{};
  message.action = action.action;
  message.ball_x = action.ball_x;
  message.ball_y = action.ball_y;
  message.strength = action.strength;
  return message;
}

naolcm::stop_command_t to_message(const StopCommand&) {
  return {};
}

const std::string& channel_of(const Command& command, const RobotChannels& channels) {
  switch (kind_of(command)) {
    case CommandKind::kWalk:
      return channels.walk_command;
    case CommandKind::kMoveTo:
      return channels.move_to_command;
    case CommandKind::kPosture:
      return channels.posture_command;
    case CommandKind::kJointChange:
      return channels.joint_change_command;
    case CommandKind::kAction:
      return channels.action_command;
    default:
      return channels.stop_command;
  }
}

}  // namespace

CommandPublisher::CommandPublisher(Bus& bus, const RobotChannels& channels)
    : bus_(bus), channels_(channels) {
  bus_.subscribe<naolcm::motion_state_t>(channels_.motion_state, Bus::Queue::kLatest,
                                         [this](const auto& state) {
                                           robot_utime_ = state.utime;
                                           if (is_napping_)
                                             bus_.set_awake(channels_.motion_state, false);
                                         });
}

void CommandPublisher::publish(const Command& command) const {
  std::visit(
      [&](const auto& request) {
        publish(channel_of(command, channels_), to_message(request), command.source, command.id);
      },
      command.request);
}

}  // namespace nao
