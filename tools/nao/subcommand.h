#pragma once

#include <functional>
#include <string>
#include <utility>

#include "common/command_line.h"
#include "common/program.h"

namespace nao {

/** Time without a message after which a program is reported as unavailable, s. Chosen: many times
 * the period of its messages. */
constexpr double kListenTimeout = 3.0;

/** Action selected on the command line; set by the subcommand. */
struct Invocation {
  CommonOptions common;
  /** Executes the subcommand. @return The exit status: 0 done, 1 refused, failed or no answer. */
  std::function<int()> run;

  /** `act` is executed if the subcommand is named. */
  void on(CommandLine& subcommand, std::function<int(const CommonOptions&)> act) {
    subcommand.on_parsed(
        [this, act = std::move(act)] { run = [this, act] { return act(common); }; });
  }
};

/** Adds walk, move-to, posture, joint, action and stop. The invocation must outlive parsing. */
void add_robot_commands(CommandLine& app, Invocation& invocation);

/** Adds say and light. */
void add_speech_commands(CommandLine& app, Invocation& invocation);

/** Adds state. */
void add_state_command(CommandLine& app, Invocation& invocation);

/** Adds world and its own subcommands. */
void add_world_commands(CommandLine& app, Invocation& invocation);

/** Adds show to the subcommands of world. */
void add_show_command(CommandLine& world, Invocation& invocation);

/** Adds status. */
void add_status_command(CommandLine& app, Invocation& invocation);

/** Adds driver and its own subcommands. */
void add_driver_commands(CommandLine& app, Invocation& invocation);

/** Adds spy. */
void add_spy_command(CommandLine& app, Invocation& invocation);

/** Adds watchdog. */
void add_watchdog_command(CommandLine& app, Invocation& invocation);

/** Adds the subcommands that nao-tools executes.
 * @param arguments  Of this program, ended by a null pointer; they are passed on. */
void add_tools_commands(CommandLine& app, Invocation& invocation, char** arguments);

/** Adds record. */
void add_record_command(CommandLine& app, Invocation& invocation);

/** Adds log and its own subcommands. */
void add_log_command(CommandLine& app, Invocation& invocation);

/** Adds robot and its own subcommands. */
void add_robot_files_command(CommandLine& app, Invocation& invocation);

/** Adds policy and its own subcommands. */
void add_policy_command(CommandLine& app, Invocation& invocation);

/** Adds calibrate. */
void add_calibrate_command(CommandLine& app, Invocation& invocation);

/** Adds play. */
void add_play_command(CommandLine& app, Invocation& invocation);

/** Adds match and its own subcommands. */
void add_match_command(CommandLine& app, Invocation& invocation);

/** Adds self-test. */
void add_self_test_command(CommandLine& app, Invocation& invocation);

/** Adds motion and its own subcommands. */
void add_motion_command(CommandLine& app, Invocation& invocation);

/** Executes an action and waits for its end. @return The exit status. */
int run_action(const CommonOptions& common, const std::string& action);

/** Adds invite. */
void add_invite_command(CommandLine& app, Invocation& invocation);

/** Adds bus. */
void add_bus_command(CommandLine& app, Invocation& invocation);

}  // namespace nao
