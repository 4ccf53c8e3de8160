#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>

#include "common/child_process.h"
#include "common/command_line.h"
#include "common/error.h"
#include "tools/nao/subcommand.h"
#include "tools/nao/tools_subcommands.h"

namespace nao {
namespace {

/** Replaces this process by nao-tools, which reads the whole command line again. */
int execute_tools(const std::string& subcommand, char** arguments) {
  const std::string folder = program_folder();
  const std::string program = folder + "/nao-tools";
  execv(program.c_str(), arguments);
  if (errno != ENOENT) throw Error(program + " cannot be started: " + std::strerror(errno));
  throw Error("nao " + subcommand + " is in the program nao-tools, which is not in " + folder +
              "; build it: cmake --build --preset dev --target nao-tools");
}

}  // namespace

void add_tools_commands(CommandLine& app, Invocation& invocation, char** arguments) {
  for (const ToolsSubcommand* subcommand : kToolsSubcommands) {
    CommandLine* command = app.add_delegated_subcommand(subcommand->name, subcommand->help);
    invocation.on(*command, [subcommand, arguments](const auto& /*common*/) {
      return execute_tools(subcommand->name, arguments);
    });
  }
}

}  // namespace nao
