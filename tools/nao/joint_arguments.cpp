#include "tools/nao/joint_arguments.h"

#include <cmath>
#include <cstdlib>

#include "common/constants.h"
#include "common/error.h"

namespace nao {
namespace {

/** @return NaN if the text is not a finite angle. */
double parse_angle(const std::string& text) {
  if (text.empty()) return std::nan("");
  char* end = nullptr;
  const double number = std::strtod(text.c_str(), &end);
  const std::string unit = end;
  if (end == text.c_str() || !std::isfinite(number)) return std::nan("");
  if (unit.empty() || unit == "rad") return number;
  if (unit == "deg") return number * kDegree;
  return std::nan("");
}

}  // namespace

JointArguments parse_joint_arguments(const std::vector<std::string>& arguments) {
  if (arguments.empty() || arguments.size() % 2 != 0) {
    throw ConfigError("give pairs of a joint and an angle, such as: HeadYaw +0.3");
  }
  JointArguments result;
  for (size_t i = 0; i < arguments.size(); i += 2) {
    const std::string& text = arguments[i + 1];
    const bool is_target = text.starts_with("=");
    const bool is_change = text.starts_with("+") || text.starts_with("-");
    const double angle = parse_angle(is_target ? text.substr(1) : text);
    if (is_target == is_change || std::isnan(angle)) {
      throw ConfigError("'" + text + "' for " + arguments[i] +
                        ": write +0.3 or -0.3 for a change, =0.3 for a target, in rad, or "
                        "+20deg");
    }
    if (i > 0 && result.is_relative != is_change) {
      throw ConfigError("either changes (+, -) or targets (=), not both in one command");
    }
    result.is_relative = is_change;
    result.names.push_back(arguments[i]);
    result.positions.push_back(angle);
  }
  return result;
}

}  // namespace nao
