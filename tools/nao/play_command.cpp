// nao play: behaviors, which nao-play executes.
#include "messages/play_command.h"

#include <memory>
#include <string>
#include <vector>

#include "common/command_line.h"
#include "tools/nao/conversation.h"
#include "tools/nao/subcommand.h"

namespace nao {
namespace {

struct PlayArguments {
  std::string behavior;
  std::vector<double> target;
  WaitOptions wait;
};

int play(const CommonOptions& common, const PlayArguments& arguments) {
  PlayCommand command{*find_behavior(arguments.behavior)};
  if (arguments.target.size() == 2) {
    command.target_in_odometry = {arguments.target[0], arguments.target[1]};
  }
  Conversation conversation(common, "play " + arguments.behavior, "nao-play");
  return conversation.run_command(conversation.channels().play_command, to_message(command),
                                  arguments.wait);
}

}  // namespace

void add_play_command(CommandLine& app, Invocation& invocation) {
  auto arguments = std::make_shared<PlayArguments>();
  CommandLine* command =
      app.add_subcommand("play", "Let the robot act by what it sees, until it is done or Ctrl-C");
  command
      ->add_option(
          "behavior", arguments->behavior,
          "go-to-ball, kick, dribble, score, keep-goal; auto: play the match, also again after "
          "a person has driven the robot; none: end what runs")
      ->required()
      ->check([](const std::string& name) {
        return find_behavior(name) ? std::string() : "there is no behavior '" + name + "'";
      });
  command
      ->add_option("--target", arguments->target,
                   "X,Y: where the ball shall go, m in the odometry frame (default: the opponent's "
                   "goal)")
      ->separated_by(',')
      ->count(2);
  add_wait_options(*command, arguments->wait);
  invocation.on(*command, [arguments](const auto& common) { return play(common, *arguments); });
}

}  // namespace nao
