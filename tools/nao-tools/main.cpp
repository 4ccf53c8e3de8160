// nao-tools: the subcommands of nao that a start of the robot does not need. nao executes this
// program for them; its command line is that of nao. See ../nao/README.md.

#include "common/command_line.h"
#include "common/program.h"
#include "tools/nao/subcommand.h"

int main(int argc, char** argv) {
  nao::CommandLine app("Subcommands of nao that a start of the robot does not need.", "nao");
  app.require_subcommand();
  app.share_options();
  app.footer("Every subcommand answers --help.");

  nao::Invocation invocation;
  nao::add_common_options(app, invocation.common);
  nao::add_spy_command(app, invocation);
  nao::add_calibrate_command(app, invocation);
  nao::add_self_test_command(app, invocation);
  nao::add_robot_files_command(app, invocation);
  nao::add_policy_command(app, invocation);
  nao::add_record_command(app, invocation);
  nao::add_log_command(app, invocation);
  return nao::run_program_with_status(app, invocation.common, argc, argv,
                                      [&invocation] { return invocation.run(); });
}
