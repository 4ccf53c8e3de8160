#include "tools/nao-tools/channel_pattern.h"

#include <array>

#include "common/error.h"

namespace nao {

ChannelPattern::ChannelPattern(const std::string& option, const std::string& expression) {
  auto compiled = std::make_unique<regex_t>();
  // Not std::regex, whose templates take the compiler seconds.
  const std::string whole = "^(" + expression + ")$";
  const int fault = regcomp(compiled.get(), whole.c_str(), REG_EXTENDED | REG_NOSUB);
  if (fault != 0) {
    std::array<char, 200> text{};
    regerror(fault, compiled.get(), text.data(), text.size());
    throw ConfigError(option + " " + expression + " is not a regular expression: " + text.data());
  }
  expression_.reset(compiled.release());
}

bool ChannelPattern::matches(const std::string& channel) const {
  return regexec(expression_.get(), channel.c_str(), 0, nullptr, 0) == 0;
}

void ChannelPattern::Free::operator()(regex_t* expression) const {
  regfree(expression);
  delete expression;
}

}  // namespace nao
