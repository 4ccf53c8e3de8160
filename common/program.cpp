#include "common/program.h"

#include <exception>
#include <string>

#include "common/command_line.h"
#include "common/logger.h"

#ifndef NAO_REMOTE_VERSION
#error "NAO_REMOTE_VERSION comes from the build"
#endif

namespace nao {

const char* version() {
  return NAO_REMOTE_VERSION;
}

namespace {

std::string fault_of_robot_name(const std::string& name) {
  const bool is_valid =
      !name.empty() && name.size() <= 20 &&
      name.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_") == std::string::npos;
  return is_valid ? "" : "a robot's name consists of 1 to 20 characters of A-Z, 0-9 and _";
}

}  // namespace

void add_common_options(CommandLine& app, CommonOptions& options) {
  app.add_version_flag("--version", app.name() + " " + version());
  app.add_option("--lcm-url", options.lcm_url, "URL of the message bus")
      ->from_environment("LCM_DEFAULT_URL")
      ->show_default();
  app.add_option("--log-level", options.log_level, "Minimum severity of printed log lines")
      ->one_of({"trace", "debug", "info", "warning", "error"})
      ->show_default();
  app.add_option("--robot", options.robot, "Name of the robot: prefix of its channels")
      ->check(fault_of_robot_name, "NAME")
      ->show_default();
}

int run_program(CommandLine& app, const CommonOptions& common, int argc, char** argv,
                const std::function<void()>& body) {
  return run_program_with_status(app, common, argc, argv, [&body] {
    body();
    return 0;
  });
}

int run_program_with_status(CommandLine& app, const CommonOptions& common, int argc, char** argv,
                            const std::function<int()>& body) {
  if (const auto status = app.parse(argc, argv)) return *status;
  logger::set_up(app.name(), common.log_level);
  try {
    return body();
  } catch (const std::exception& error) {
    logger::error("{}", error.what());
    return 1;
  }
}

}  // namespace nao
