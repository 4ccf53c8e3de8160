// nao: drive and watch the robot from a terminal. See README.md.

#include "common/command_line.h"
#include "common/program.h"
#include "tools/nao/subcommand.h"

int main(int argc, char** argv) {
  nao::CommandLine app("Drive and watch the robot from a terminal.", "nao");
  app.require_subcommand();
  app.share_options();
  app.footer(
      "Examples:\n"
      "  nao posture Stand             stand up, wait until the robot stands\n"
      "  nao walk 0.1 0 0 --for 5      walk ahead at 0.1 m/s for 5 s\n"
      "  nao move-to 0.5 0 90deg       walk half a metre ahead, end turned to the left\n"
      "  nao joint HeadYaw +20deg      turn the head to the left\n"
      "  nao action kick-left && echo scored\n"
      "  nao say \"Hello\"              speak; --language de for another language\n"
      "  nao light left-eye right-eye green\n"
      "  nao motion save wave.yaml     check a taught motion in a simulation and save it\n"
      "  nao state --watch             the robot's state, refreshed continuously\n"
      "Exit status: 0 done; 1 refused, failed or no answer (the reason is on stderr); 2 bad "
      "command line.\n"
      "Every subcommand answers --help.");

  nao::Invocation invocation;
  nao::add_common_options(app, invocation.common);
  nao::add_robot_commands(app, invocation);
  nao::add_speech_commands(app, invocation);
  nao::add_state_command(app, invocation);
  nao::add_world_commands(app, invocation);
  nao::add_status_command(app, invocation);
  nao::add_driver_commands(app, invocation);
  nao::add_invite_command(app, invocation);
  nao::add_bus_command(app, invocation);
  nao::add_motion_command(app, invocation);
  nao::add_play_command(app, invocation);
  nao::add_match_command(app, invocation);
  nao::add_watchdog_command(app, invocation);
  nao::add_tools_commands(app, invocation, argv);
  return nao::run_program_with_status(app, invocation.common, argc, argv,
                                      [&invocation] { return invocation.run(); });
}
