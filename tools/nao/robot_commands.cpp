#include <cmath>
#include <cstdlib>
#include <limits>
#include <memory>
#include <naolcm/action_command_t.hpp>
#include <naolcm/joint_change_command_t.hpp>
#include <naolcm/move_to_command_t.hpp>
#include <naolcm/posture_command_t.hpp>
#include <naolcm/stop_command_t.hpp>
#include <naolcm/walk_command_t.hpp>
#include <string>
#include <vector>

#include "common/command_line.h"
#include "common/error.h"
#include "tools/nao/conversation.h"
#include "tools/nao/joint_arguments.h"
#include "tools/nao/subcommand.h"

namespace nao {
namespace {

/** Rejects a length, speed or angle that is not a finite number. @return The fault, or "". */
std::string fault_unless_finite(const std::string& text) {
  char* end = nullptr;
  const double number = std::strtod(text.c_str(), &end);
  return *end == '\0' && std::isfinite(number) ? "" : "'" + text + "' is not a finite number";
}

void add_walk(CommandLine& app, Invocation& invocation) {
  auto command = std::make_shared<naolcm::walk_command_t>();
  auto duration = std::make_shared<double>(kForever);
  CommandLine* walk = app.add_subcommand(
      "walk", "Walk at a velocity until Ctrl-C; the command is sent ten times a second");
  walk->add_option("vx", command->vx, "Ahead, m/s")->required()->check(fault_unless_finite);
  walk->add_option("vy", command->vy, "To the left, m/s")->required()->check(fault_unless_finite);
  walk->add_option("wz", command->wz, "Turning to the left, rad/s")
      ->required()
      ->check(fault_unless_finite);
  walk->add_option("--for", *duration, "Duration of the walk before the robot stands, s")
      ->positive();
  invocation.on(*walk, [command, duration](const auto& common) {
    return Conversation(common, "walk", "nao-motion", CommandExchange::kWalkTiming)
        .run_walk(*command, *duration);
  });
}

void add_move_to(CommandLine& app, Invocation& invocation) {
  auto command = std::make_shared<naolcm::move_to_command_t>();
  auto theta = std::make_shared<std::string>("0");
  auto wait = std::make_shared<WaitOptions>();
  CommandLine* move_to = app.add_subcommand("move-to", "Walk to a pose in the robot's frame");
  move_to->add_option("x", command->x, "Ahead, m")->required()->check(fault_unless_finite);
  move_to->add_option("y", command->y, "To the left, m")->required()->check(fault_unless_finite);
  move_to->add_option("theta", *theta, "Final heading, counterclockwise, rad, or such as 90deg");
  add_wait_options(*move_to, *wait);
  move_to->on_parsed([&invocation, command, theta, wait] {
    try {
      command->theta = parse_joint_arguments({"theta", "=" + *theta}).positions[0];
    } catch (const ConfigError&) {
      throw UsageError("theta", "'" + *theta + "' is not an angle");
    }
    invocation.run = [&invocation, command, wait] {
      Conversation conversation(invocation.common, "move-to");
      return conversation.run_command(conversation.channels().move_to_command, *command, *wait);
    };
  });
}

void add_posture(CommandLine& app, Invocation& invocation) {
  auto command = std::make_shared<naolcm::posture_command_t>();
  command->speed = 0.5;
  auto wait = std::make_shared<WaitOptions>();
  CommandLine* posture = app.add_subcommand("posture", "Go to a posture: Stand, Crouch, Sit ...");
  posture->add_option("name", command->posture, "Name as in robots/nao/postures.yaml")->required();
  posture->add_option("--speed", command->speed, "Fraction of the maximum speed, above 0 up to 1")
      ->check(fault_unless_finite);
  add_wait_options(*posture, *wait);
  invocation.on(*posture, [command, wait](const auto& common) {
    Conversation conversation(common, "posture " + command->posture);
    return conversation.run_command(conversation.channels().posture_command, *command, *wait);
  });
}

void add_joint(CommandLine& app, Invocation& invocation) {
  auto command = std::make_shared<naolcm::joint_change_command_t>();
  command->speed = 0.3;
  auto allow_tipping = std::make_shared<bool>(false);
  auto arguments = std::make_shared<std::vector<std::string>>();
  auto wait = std::make_shared<WaitOptions>();
  CommandLine* joint = app.add_subcommand(
      "joint", "Turn joints: \"HeadYaw +0.3\" by an angle, \"HeadYaw =0.3\" to an angle");
  joint
      ->add_option("joints", *arguments, "Pairs of a joint and +, - or = with an angle, rad or deg")
      ->required();
  joint->add_option("--speed", command->speed, "Fraction of the maximum speed, above 0 up to 1")
      ->check(fault_unless_finite);
  joint->add_flag("--allow-tipping", *allow_tipping, "Execute it even if the robot tips over");
  add_wait_options(*joint, *wait);
  joint->on_parsed([&invocation, command, allow_tipping, arguments, wait] {
    JointArguments joints;
    try {
      joints = parse_joint_arguments(*arguments);
    } catch (const ConfigError& error) {
      throw UsageError("joints", error.what());
    }
    command->num_joints = static_cast<int32_t>(joints.names.size());
    command->joint_names = joints.names;
    command->joint_position = joints.positions;
    command->joint_stiffness.assign(joints.positions.size(),
                                    std::numeric_limits<double>::quiet_NaN());
    command->is_relative = static_cast<int8_t>(joints.is_relative);
    command->allow_tipping = static_cast<int8_t>(*allow_tipping);
    invocation.run = [&invocation, command, wait] {
      Conversation conversation(invocation.common, "joint");
      return conversation.run_command(conversation.channels().joint_change_command, *command,
                                      *wait);
    };
  });
}

void add_action(CommandLine& app, Invocation& invocation) {
  auto command = std::make_shared<naolcm::action_command_t>();
  command->ball_x = command->ball_y = command->strength = std::nan("");
  auto ball = std::make_shared<std::vector<double>>();
  auto wait = std::make_shared<WaitOptions>();
  CommandLine* action =
      app.add_subcommand("action", "Execute an action of the robot's robot.yaml, such as get-up");
  action->add_option("name", command->action, "Name of the action")->required();
  action->add_option("--ball", *ball, "For kicks: where the ball lies, ahead and to the left, m")
      ->count(2)
      ->check(fault_unless_finite);
  action->add_option("--strength", command->strength, "For kicks: above 0 up to 1")
      ->check(fault_unless_finite);
  add_wait_options(*action, *wait);
  action->on_parsed([&invocation, command, ball, wait] {
    if (ball->size() == 2) {
      command->ball_x = (*ball)[0];
      command->ball_y = (*ball)[1];
    }
    invocation.run = [&invocation, command, wait] {
      Conversation conversation(invocation.common, "action " + command->action);
      return conversation.run_command(conversation.channels().action_command, *command, *wait);
    };
  });
}

void add_stop(CommandLine& app, Invocation& invocation) {
  auto wait = std::make_shared<WaitOptions>();
  CommandLine* stop = app.add_subcommand("stop", "End any motion");
  add_wait_options(*stop, *wait);
  invocation.on(*stop, [wait](const auto& common) {
    Conversation conversation(common, "stop");
    return conversation.run_command(conversation.channels().stop_command, naolcm::stop_command_t(),
                                    *wait);
  });
}

}  // namespace

int run_action(const CommonOptions& common, const std::string& action) {
  naolcm::action_command_t command{};
  command.action = action;
  command.ball_x = command.ball_y = command.strength = std::nan("");
  Conversation conversation(common, "action " + action);
  return conversation.run_command(conversation.channels().action_command, command, WaitOptions());
}

void add_robot_commands(CommandLine& app, Invocation& invocation) {
  add_walk(app, invocation);
  add_move_to(app, invocation);
  add_posture(app, invocation);
  add_joint(app, invocation);
  add_action(app, invocation);
  add_stop(app, invocation);
}

}  // namespace nao
