#include "common/robot_option.h"

#include <algorithm>
#include <charconv>

#include "common/command_line.h"
#include "common/error.h"

namespace nao {
namespace {

std::vector<std::string> split(const std::string& text) {
  std::vector<std::string> parts{""};
  for (const char c : text) {
    if (c == ':') {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

/** @throws ConfigError  if the text is not a number in the range. */
int parse_number(const std::string& text, int least, int greatest, const std::string& what) {
  int number = 0;
  const char* end = text.data() + text.size();
  const auto [last, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc() || last != end || number < least || number > greatest) {
    throw ConfigError(what + " '" + text + "' is not a number from " + std::to_string(least) +
                      " to " + std::to_string(greatest));
  }
  return number;
}

}  // namespace

std::string fault_of_robot_name(const std::string& name) {
  const bool is_valid =
      !name.empty() && name.size() <= 20 &&
      name.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_") == std::string::npos;
  return is_valid ? "" : "a robot's name consists of 1 to 20 characters of A-Z, 0-9 and _";
}

RobotOption parse_robot_option(const std::string& text) {
  const std::vector<std::string> parts = split(text);
  if (parts.size() == 3 || parts.size() > 4) {
    throw ConfigError("--robot " + text + " is not NAME, NAME:MODEL or NAME:MODEL:TEAM:NUMBER");
  }
  if (const std::string fault = fault_of_robot_name(parts[0]); !fault.empty()) {
    throw ConfigError("--robot " + text + ": " + fault);
  }
  RobotOption robot;
  robot.name = parts[0];
  if (parts.size() > 1) robot.model = parts[1];
  if (parts.size() > 3) {
    // LCM carries both as 8-bit numbers (player_t).
    robot.team = parse_number(parts[2], 0, 1, "--robot " + text + ": the team");
    robot.number = parse_number(parts[3], 1, 99, "--robot " + text + ": the number");
  }
  return robot;
}

std::vector<RobotOption> parse_robot_options(const std::vector<std::string>& texts,
                                             const std::string& default_model) {
  std::vector<RobotOption> robots;
  for (const std::string& text : texts) {
    RobotOption robot = parse_robot_option(text);
    if (robot.model.empty()) robot.model = default_model;
    const bool is_repeated = std::any_of(
        robots.begin(), robots.end(), [&](const auto& other) { return other.name == robot.name; });
    if (is_repeated) throw ConfigError("--robot names " + robot.name + " twice");
    robots.push_back(std::move(robot));
  }
  if (robots.empty()) throw ConfigError("--robot names no robot");
  return robots;
}

void add_robot_option(CommandLine& app, std::vector<std::string>& texts) {
  app.add_option("--robot", texts,
                 "Name of a robot, which is the prefix of its channels, and the folder of robots/ "
                 "that describes it (default: --model), and its team (0 or 1) and number; "
                 "repeatable")
      ->check(
          [](const std::string& text) -> std::string {
            try {
              (void)parse_robot_option(text);
              return "";
            } catch (const ConfigError& error) {
              return error.what();
            }
          },
          "NAME[:MODEL[:TEAM:NUMBER]]");
}

}  // namespace nao
