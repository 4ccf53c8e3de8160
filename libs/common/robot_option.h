#pragma once

#include <optional>
#include <string>
#include <vector>

namespace nao {

class CommandLine;

/** A robot that a program for several robots names on its command line. */
struct RobotOption {
  /** Prefix of its channels. */
  std::string name;
  /** Folder of robots/ that describes it; empty: the program's --model. */
  std::string model;
  /** Team, 0 or 1, and number on the shirt, 1 or more; absent and 0: none. */
  std::optional<int> team{};
  int number = 0;
};

/** Reads NAME, NAME:MODEL or NAME:MODEL:TEAM:NUMBER.
 * @throws ConfigError  naming what is wrong. */
RobotOption parse_robot_option(const std::string& text);

/** Reads all of them. @param default_model  Of those without a model.
 * @throws ConfigError  naming what is wrong: also two of one name, or none. */
std::vector<RobotOption> parse_robot_options(const std::vector<std::string>& texts,
                                             const std::string& default_model);

/** What is wrong with the name of a robot; empty: nothing. */
std::string fault_of_robot_name(const std::string& name);

/** Adds --robot NAME[:MODEL[:TEAM:NUMBER]], repeatable. The value that `texts` has is the default.
 */
void add_robot_option(CommandLine& app, std::vector<std::string>& texts);

}  // namespace nao
