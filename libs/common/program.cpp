#include "common/program.h"

#include <exception>
#include <string>

#include "common/command_line.h"
#include "common/local_multicast.h"
#include "common/logger.h"
#include "common/robot_option.h"

#ifndef NAO_REMOTE_VERSION
#error "NAO_REMOTE_VERSION comes from the build"
#endif

namespace nao {

const char* version() {
  return NAO_REMOTE_VERSION;
}

void add_log_option(CommandLine& app, CommonOptions& options) {
  app.add_version_flag("--version", app.name() + " " + version());
  app.add_option("--log-level", options.log_level, "Minimum severity of printed log lines")
      ->one_of({"trace", "debug", "info", "warning", "error"});
}

void add_bus_options(CommandLine& app, CommonOptions& options) {
  app.add_option("--lcm-url", options.lcm_url, "URL of the message bus")
      ->from_environment("LCM_DEFAULT_URL");
  add_log_option(app, options);
}

void add_common_options(CommandLine& app, CommonOptions& options) {
  add_bus_options(app, options);
  app.add_option("--robot", options.robot, "Name of the robot: prefix of its channels")
      ->check(fault_of_robot_name, "NAME");
}

void add_model_option(CommandLine& app, std::string& model) {
  app.add_option("--model", model, "Folder of robots/ that describes the robot");
}

int run_program(CommandLine& app, const CommonOptions& common, int argc, char** argv,
                const std::function<void()>& body) {
  return run_program_with_status(app, common, argc, argv, [&body] {
    body();
    return 0;
  });
}

// Exit status: the body's own, 1 after an error, 2 after a wrong command line.
int run_program_with_status(CommandLine& app, const CommonOptions& common, int argc, char** argv,
                            const std::function<int()>& body) {
  if (const auto status = app.parse(argc, argv)) return *status;
  logger::set_up(app.name(), common.log_level);
  if (is_local_bus(common.lcm_url)) keep_multicast_local();
  try {
    return body();
  } catch (const std::exception& error) {
    logger::error("{}", error.what());
    return 1;
  }
}

}  // namespace nao
