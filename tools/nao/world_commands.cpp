#include <cmath>
#include <functional>
#include <memory>
#include <naolcm/world_command_t.hpp>
#include <naolcm/world_truth_t.hpp>
#include <string>
#include <vector>

#include "common/channels.h"
#include "common/command_line.h"
#include "tools/nao/conversation.h"
#include "tools/nao/subcommand.h"

namespace nao {
namespace {

/** Sends a world command until WORLD_TRUTH acknowledges it. @return The exit status. */
int run_world(const CommonOptions& common, const naolcm::world_command_t& command) {
  Conversation conversation(common, "world " + command.command, "nao-sim");
  conversation.bus().subscribe<naolcm::world_truth_t>(
      kWorldTruthChannel, Bus::Queue::kLatest, [&conversation](const auto& truth) {
        if (truth.last_command_source != conversation.source() ||
            truth.last_command_id != conversation.command_id()) {
          return;
        }
        const bool is_done = truth.last_command_error.empty();
        conversation.handle_result(is_done ? ResultStatus::kDone : ResultStatus::kRefused,
                                   truth.last_command_error);
      });
  return conversation.run_command(kWorldCommandChannel, command, {});
}

/** Adds one subcommand of `nao world`. @return The subcommand and its message, for its options. */
std::pair<CommandLine*, std::shared_ptr<naolcm::world_command_t>> add_world_command(
    CommandLine& world, Invocation& invocation, const std::string& name, const std::string& help,
    std::function<void(naolcm::world_command_t&)> complete = [](naolcm::world_command_t&) {}) {
  auto command = std::make_shared<naolcm::world_command_t>();
  *command = naolcm::world_command_t{};
  command->command = name;
  CommandLine* subcommand = world.add_subcommand(name, help);
  subcommand->on_parsed([&invocation, command, complete = std::move(complete)] {
    complete(*command);
    invocation.run = [&invocation, command] {
      // The simulator knows the robot by the same name as the channels.
      if (command->robot.empty()) command->robot = invocation.common.robot;
      return run_world(invocation.common, *command);
    };
  });
  return {subcommand, command};
}

}  // namespace

void add_world_commands(CommandLine& app, Invocation& invocation) {
  CommandLine* world = app.add_subcommand("world", "Show and change the simulated world");
  world->require_subcommand();
  add_show_command(*world, invocation);
  add_world_command(*world, invocation, "pause", "Stop simulated time");
  add_world_command(*world, invocation, "resume", "Resume simulated time");
  add_world_command(*world, invocation, "reset", "Reset the world to its initial state");

  const auto [step, step_command] =
      add_world_command(*world, invocation, "step", "While paused: run some control ticks");
  step_command->num_ticks = 1;
  step->add_option("ticks", step_command->num_ticks, "How many")->positive();

  const auto [pace, pace_command] =
      add_world_command(*world, invocation, "set-pace", "Set the rate of simulated time");
  pace->add_option("pace", pace_command->pace,
                   "Simulated seconds per second; 0: as fast as possible")
      ->required()
      ->not_negative();

  const auto [push, push_command] =
      add_world_command(*world, invocation, "push", "Apply an impulse to the robot or the ball");
  push->add_option("x", push_command->impulse_in_world[0], "Impulse along the field, N s")
      ->required();
  push->add_option("y", push_command->impulse_in_world[1], "To the left of it, N s")->required();
  push->add_option("z", push_command->impulse_in_world[2], "Upwards, N s")->required();
  push->add_option("--link", push_command->link,
                   "Link as in the URDF, or ball (default: the root, the torso)");

  const auto [touch, touch_command] = add_world_command(
      *world, invocation, "touch", "Press a button or touch sensor of a robot behind LoLA");
  // 0.1 s: longer than a button bounces, far shorter than the 3 s of the chest button.
  touch_command->num_ticks = 8;
  touch->add_option("name", touch_command->link, "Such as chest-button")->required();
  touch->add_option("--ticks", touch_command->num_ticks, "Control ticks, usually of 12 ms")
      ->positive();

  auto ball_velocity = std::make_shared<std::vector<double>>();
  const auto [ball, ball_command] =
      add_world_command(*world, invocation, "place-ball", "Place the ball",
                        [ball_velocity](naolcm::world_command_t& command) {
                          for (size_t i = 0; i < ball_velocity->size(); ++i) {
                            command.velocity_in_world[i] = (*ball_velocity)[i];
                          }
                        });
  ball->add_option("x", ball_command->position_in_world[0], "Along the field, m")->required();
  ball->add_option("y", ball_command->position_in_world[1], "To the left of it, m")->required();
  ball->add_option("--height", ball_command->position_in_world[2], "Above the ground, m");
  ball->add_option("--velocity", *ball_velocity, "m/s")->count(3);

  const auto [add, add_command] =
      add_world_command(*world, invocation, "add-robot", "Add a robot, which stands");
  add->add_option("name", add_command->robot, "Its name, which is the prefix of its channels")
      ->required();
  add->add_option("x", add_command->position_in_world[0], "Along the field, m")->required();
  add->add_option("y", add_command->position_in_world[1], "To the left of it, m")->required();
  add->add_option("--model", add_command->model,
                  "Folder of robots/ that describes it (default: as of the first robot)");
  const auto [remove, remove_command] =
      add_world_command(*world, invocation, "remove-robot", "Take a robot away");
  remove->add_option("name", remove_command->robot, "Its name")->required();

  auto theta = std::make_shared<double>(0);
  const auto [place, place_command] =
      add_world_command(*world, invocation, "place-robot", "Place the robot",
                        [theta](naolcm::world_command_t& command) {
                          command.orientation_in_world[0] = std::cos(*theta / 2);
                          command.orientation_in_world[3] = std::sin(*theta / 2);
                        });
  place->add_option("x", place_command->position_in_world[0], "Along the field, m")->required();
  place->add_option("y", place_command->position_in_world[1], "To the left of it, m")->required();
  place->add_option("--theta", *theta, "Heading, rad");
  place->add_option("--height", place_command->position_in_world[2], "Above the ground, m");
  place->add_option("--posture", place_command->posture, "Posture of the placed robot");
}

}  // namespace nao
