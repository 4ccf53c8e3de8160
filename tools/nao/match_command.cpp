// nao match: shows a match, and overrules its referee.
#include "messages/match_command.h"

#include <cmath>
#include <cstdio>
#include <memory>
#include <string>

#include "common/bus.h"
#include "common/channels.h"
#include "common/command_line.h"
#include "common/event_loop.h"
#include "messages/match_state.h"
#include "tools/nao/conversation.h"
#include "tools/nao/subcommand.h"

namespace nao {
namespace {

int overrule(const CommonOptions& common, const MatchCommand& command) {
  Conversation conversation(common, "match " + std::string(to_string(command.operation)),
                            "nao-referee");
  conversation.take_results(kMatchCommandResultChannel);
  return conversation.run_command(kMatchCommandChannel, to_message(command), {});
}

/** "playing, half 1, 4:07 left, 2:1". */
std::string to_text(const MatchState& state) {
  const int seconds = static_cast<int>(std::ceil(state.time_left));
  char line[120];
  std::snprintf(line, sizeof line, "%s, half %d, %d:%02d left, %d:%d\n",
                std::string(to_string(state.phase)).c_str(), state.half, seconds / 60, seconds % 60,
                state.score[0], state.score[1]);
  std::string text = line;
  for (const MatchPlayer& player : state.players) {
    text += player.robot + "  team " + std::to_string(player.team) + ", number " +
            std::to_string(player.number) + (player.is_autonomous ? ", plays by itself" : "");
    if (player.penalty != Penalty::kNone) {
      text += ", penalty " + std::string(to_string(player.penalty)) + " for " +
              std::to_string(static_cast<int>(std::ceil(player.penalty_left))) + " s";
    }
    text += "\n";
  }
  return text;
}

int show(const CommonOptions& common) {
  EventLoop loop;
  Bus bus(common.lcm_url);
  std::string text;
  bus.subscribe<naolcm::match_state_t>(kMatchStateChannel, Bus::Queue::kLatest,
                                       [&](const auto& message) {
                                         text = to_text(to_match_state(message));
                                         loop.stop("answer");
                                       });
  loop.on_readable(bus.descriptor(), [&bus] { bus.handle(); });
  loop.every(kListenTimeout, [&loop] { loop.stop("timeout"); });
  loop.run();
  if (text.empty()) {
    std::fprintf(stderr, "nao: match show: nao-referee does not answer; is it running?\n");
    return 1;
  }
  std::fputs(text.c_str(), stdout);
  return 0;
}

CommandLine* add_operation(CommandLine& match, Invocation& invocation, MatchOperation operation,
                           const std::string& help) {
  auto command = std::make_shared<MatchCommand>();
  command->operation = operation;
  CommandLine* subcommand = match.add_subcommand(std::string(to_string(operation)), help);
  if (needs_team(operation)) {
    subcommand->add_option("team", command->team, "0, which plays along x, or 1")
        ->required()
        ->range(0, 1);
  }
  if (needs_robot(operation)) {
    subcommand->add_option("name", command->robot, "The robot's name")->required();
  }
  invocation.on(*subcommand, [command](const auto& common) { return overrule(common, *command); });
  return subcommand;
}

}  // namespace

void add_match_command(CommandLine& app, Invocation& invocation) {
  CommandLine* match = app.add_subcommand("match", "Show a match, or overrule its referee");
  match->require_subcommand();
  CommandLine* shown = match->add_subcommand("show", "Phase, clock, score, players");
  invocation.on(*shown, show);
  using enum MatchOperation;
  add_operation(*match, invocation, kStart, "Begin, with the kick-off of the first half");
  add_operation(*match, invocation, kKickOff, "A team kicks off anew");
  add_operation(*match, invocation, kGoal,
                "One goal more for a team, which the other one kicks off after");
  add_operation(*match, invocation, kTakeBackGoal, "One goal less for a team");
  add_operation(*match, invocation, kPenalize, "A robot is put beside the field for a while");
  add_operation(*match, invocation, kRelease, "A robot's penalty ends");
  add_operation(*match, invocation, kEndHalf, "The half ends at once");
  add_operation(*match, invocation, kFinish, "The match ends at once");
  add_operation(*match, invocation, kNewMatch, "Another match, 0:0, which waits for its start");
}

}  // namespace nao
