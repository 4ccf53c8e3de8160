#pragma once

#include <string>
#include <vector>

namespace nao {

/** Joints and angles as given on a command line. */
struct JointArguments {
  std::vector<std::string> names;
  /** rad; changes or targets, (names.size()). */
  std::vector<double> positions;
  bool is_relative = true;
};

/** Reads pairs of a joint's name and "+0.3", "-0.3" (a change) or "=0.3" (a target), in rad, or in
 * degrees with the suffix "deg": {"HeadYaw", "+20deg"}.
 * @throws ConfigError  if an argument is invalid, or if changes and targets are mixed. */
JointArguments parse_joint_arguments(const std::vector<std::string>& arguments);

}  // namespace nao
