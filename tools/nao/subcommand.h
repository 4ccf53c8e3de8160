#pragma once

#include <functional>
#include <string>

#include "common/program.h"

namespace CLI {
class App;
}

namespace nao {

/** What the command line asked for: filled in by the subcommand that was named. */
struct Invocation {
  CommonOptions common;
  /** Does it. @return The exit status: 0 done, 1 refused, failed or no answer. */
  std::function<int()> run;
};

/** Adds walk, move-to, posture, joint, action and stop. The invocation must outlive parsing. */
void add_robot_commands(CLI::App& app, Invocation& invocation);

/** Adds state. */
void add_state_command(CLI::App& app, Invocation& invocation);

/** Adds world and its own subcommands. */
void add_world_commands(CLI::App& app, Invocation& invocation);

/** Adds show to the subcommands of world. */
void add_show_command(CLI::App& world, Invocation& invocation);

/** Adds status. */
void add_status_command(CLI::App& app, Invocation& invocation);

/** Adds driver and its own subcommands. */
void add_driver_commands(CLI::App& app, Invocation& invocation);

/** Adds spy. */
void add_spy_command(CLI::App& app, Invocation& invocation);

/** Adds watchdog. */
void add_watchdog_command(CLI::App& app, Invocation& invocation);

/** Adds record. */
void add_record_command(CLI::App& app, Invocation& invocation);

/** Adds log and its own subcommands. */
void add_log_command(CLI::App& app, Invocation& invocation);

/** Adds bus. */
void add_bus_command(CLI::App& app, Invocation& invocation);

}  // namespace nao
