#include "common/program.h"

#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <exception>
#include <string>

#ifndef NAO_REMOTE_VERSION
#error "NAO_REMOTE_VERSION comes from the build"
#endif

namespace nao {

const char* version() {
  return NAO_REMOTE_VERSION;
}

void add_common_options(CLI::App& app, CommonOptions& options) {
  app.set_version_flag("--version", app.get_name() + " " + version());
  app.add_option("--lcm-url", options.lcm_url, "Bus to meet the other programs on")
      ->envname("LCM_DEFAULT_URL")
      ->capture_default_str();
  app.add_option("--log-level", options.log_level, "Least severe log line to print")
      ->check(CLI::IsMember({"trace", "debug", "info", "warning", "error"}))
      ->capture_default_str();
  const CLI::Validator robot_name(
      [](const std::string& name) -> std::string {
        const bool valid =
            !name.empty() && name.size() <= 20 &&
            name.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_") == std::string::npos;
        return valid ? "" : "a robot's name is 1 to 20 of A-Z, 0-9 and _";
      },
      "NAME", "robot name");
  app.add_option("--robot", options.robot, "Name of the robot, which its channels begin with")
      ->check(robot_name)
      ->capture_default_str();
}

int run_program(CLI::App& app, const CommonOptions& common, int argc, char** argv,
                const std::function<void()>& body) {
  return run_program_with_status(app, common, argc, argv, [&body] {
    body();
    return 0;
  });
}

int run_program_with_status(CLI::App& app, const CommonOptions& common, int argc, char** argv,
                            const std::function<int()>& body) {
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  auto logger = spdlog::stderr_color_mt(app.get_name());
  logger->set_pattern("%Y-%m-%d %H:%M:%S.%e %^%l%$ %n: %v");
  logger->set_level(spdlog::level::from_str(common.log_level));
  spdlog::set_default_logger(logger);
  try {
    return body();
  } catch (const std::exception& error) {
    spdlog::error("{}", error.what());
    return 1;
  }
}

}  // namespace nao
