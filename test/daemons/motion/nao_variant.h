#pragma once

#include <sstream>
#include <stdexcept>
#include <string>

#include "test/libs/robot_model/copied_robot.h"

namespace nao::motion {

/** The NAO with another value of a key of its robot.yaml. The key must be on a line of its own.
 * @param value  YAML of one line. */
inline RobotModel load_nao_variant(const std::string& key, const std::string& value) {
  const CopiedRobot robot;
  std::istringstream original(robot.read("robot.yaml"));
  std::string changed;
  bool is_found = false;
  for (std::string line; std::getline(original, line);) {
    const bool is_key = line.starts_with(key + ":");
    is_found = is_found || is_key;
    changed += (is_key ? key + ": " + value : line) + "\n";
  }
  if (!is_found) throw std::runtime_error("robot.yaml has no key " + key);
  robot.write("robot.yaml", changed);
  return RobotModel::load(robot.path());
}

}  // namespace nao::motion
