#include "tools/walk-tuner/gait_file.h"

#include <spdlog/fmt/fmt.h>

#include "common/error.h"

namespace nao {

std::string with_gait_values(const std::string& text, const motion::Gait& gait,
                             const std::vector<motion::Gait::Parameter>& parameters) {
  std::string result = "\n" + text;
  for (const motion::Gait::Parameter& parameter : parameters) {
    const std::string head = fmt::format("\n{}: {{value: ", parameter.key);
    const size_t at = result.find(head);
    const size_t end = at == std::string::npos ? at : result.find(',', at + head.size());
    if (end == std::string::npos) {
      throw Error(fmt::format("no line \"{}: {{value: ...\" in the gait file", parameter.key));
    }
    result.replace(at + head.size(), end - at - head.size(),
                   fmt::format("{:.4g}", gait.*parameter.member));
  }
  return result.substr(1);
}

}  // namespace nao
