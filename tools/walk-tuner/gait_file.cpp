#include "tools/walk-tuner/gait_file.h"

#include <fmt/core.h>

#include <sstream>

#include "common/error.h"
#include "robot_import/gait_text.h"

namespace nao::tool {
namespace {

constexpr const char* kValue = ": {value: ";
// In the place of kUntunedGait.
constexpr const char* kTunedGait = "then tuned";

/** Name of the group that a line begins ("timing:"), or "". */
std::string group_of(const std::string& line) {
  const bool is_group = !line.empty() && line.front() != ' ' && line.back() == ':';
  return is_group ? line.substr(0, line.size() - 1) : "";
}

/** Key of a line "  KEY: {value: ...", or "". */
std::string key_of(const std::string& line) {
  const size_t end = line.find(kValue);
  const bool is_key = end != std::string::npos && line.compare(0, 2, "  ") == 0 && line[2] != '#';
  return is_key ? line.substr(2, end - 2) : "";
}

}  // namespace

std::string with_gait_values(const std::string& text, const motion::Gait& gait,
                             const std::vector<motion::Gait::Parameter>& parameters) {
  std::vector<motion::Gait::Parameter> left = parameters;
  std::string result;
  std::string group;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (!group_of(line).empty()) group = group_of(line);
    const size_t untuned = line.find(kUntunedGait);
    if (untuned != std::string::npos) {
      line.replace(untuned, std::string(kUntunedGait).size(), kTunedGait);
    }
    const std::string name = group + "." + key_of(line);
    for (size_t i = 0; i < left.size(); ++i) {
      if (left[i].name != name) continue;
      const size_t start = line.find(kValue) + std::string(kValue).size();
      line.replace(start, line.find(',', start) - start,
                   fmt::format("{:.4g}", left[i].value(gait)));
      left.erase(left.begin() + static_cast<long>(i));
      break;
    }
    result += line + "\n";
  }
  if (!left.empty()) {
    throw Error(
        fmt::format("the gait file has no line \"  KEY: {{value: ...\" for {}", left.front().name));
  }
  return result;
}

}  // namespace nao::tool
