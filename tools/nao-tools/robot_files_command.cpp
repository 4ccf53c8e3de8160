// nao robot: imports and checks the files of a robot.

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

#include "common/command_line.h"
#include "common/data_path.h"
#include "common/error.h"
#include "robot_import/robot_import.h"
#include "tools/nao/subcommand.h"
#include "tools/nao/tools_subcommands.h"
#include "tools/robot-trial/robot_trial.h"

namespace nao {
namespace {

// Duration of the search after an import, on two cores.
constexpr double kSearchMinutes = 2;

const char* name_of(Finding::Severity severity) {
  switch (severity) {
    case Finding::Severity::kNote:
      return "note";
    case Finding::Severity::kRepaired:
      return "repaired";
    case Finding::Severity::kMissing:
      return "missing";
  }
  return "";
}

void print(const Findings& findings) {
  for (const Finding& finding : findings) {
    std::printf("%-9s %s\n", name_of(finding.severity), to_line(finding).c_str());
  }
}

/** @param robots  Empty: those of the installed data. @param name  One folder's, "t1". */
std::filesystem::path folder_of(const std::filesystem::path& robots, const std::string& name) {
  if (name.empty() || name == "." || name == ".." ||
      std::filesystem::path(name).filename() != name) {
    throw ConfigError("the robot's name \"" + name + "\" is not a folder's name, such as t1");
  }
  return (robots.empty() ? data_path() / "robots" : robots) / name;
}

}  // namespace

void add_robot_files_command(CommandLine& app, Invocation& invocation) {
  CommandLine* robot = app.add_subcommand(kRobotSubcommand.name, kRobotSubcommand.help);
  robot->require_subcommand();

  struct Options {
    std::string urdf;
    std::string name;
    std::string folder;
    bool is_simulated = true;
    double tune_minutes = 0;
  };
  const auto options = std::make_shared<Options>();
  CommandLine* importer = robot->add_subcommand(
      "import",
      "Make robots/NAME from a URDF; lists what it repaired, assumed and misses, and simulates it "
      "for up to two minutes to find settings with which it stands and walks");
  importer->add_option("urdf", options->urdf, "The URDF; of xacro its output")->required();
  importer->add_option("--name", options->name, "Name of the robot's folder")->required();
  importer->add_option("--tune", options->tune_minutes, "Then search a better gait, minutes")
      ->not_negative();
  importer->add_flag("!--no-simulation", options->is_simulated, "Do not simulate it");
  invocation.on(*importer, [options](const auto& /*common*/) {
    const auto folder = folder_of(options->folder, options->name);
    print(import_robot(options->urdf, folder));
    std::printf("wrote %s\n", folder.c_str());
    if (!options->is_simulated) return 0;
    const RobotCard card =
        try_robot(folder, kSearchMinutes, options->tune_minutes, [](const std::string& line) {
          std::printf("%s\n", line.c_str());
          std::fflush(stdout);
        });
    std::printf("%s", to_text(card).c_str());
    return 0;
  });

  CommandLine* check = robot->add_subcommand(
      "check", "List what a robot misses for standing, walking, postures and kicks");
  check->add_option("name", options->name, "Name of the robot's folder")->required();
  for (CommandLine* command : {importer, check}) {
    command->add_option("--folder", options->folder,
                        "Folder of the robots; default: robots/ of the installed data");
  }
  invocation.on(*check, [options](const auto& /*common*/) {
    const Findings findings = check_robot(folder_of(options->folder, options->name));
    print(findings);
    if (findings.empty()) std::printf("%s has everything\n", options->name.c_str());
    return 0;
  });
}

}  // namespace nao
