#pragma once

#include <regex.h>

#include <memory>
#include <string>

namespace nao {

/** Selects channels by a regular expression (POSIX, extended) that must match a channel's whole
 * name. */
class ChannelPattern {
 public:
  /** @param option  Where the expression comes from, such as "--channels".
   * @throws ConfigError  It is not a regular expression. */
  ChannelPattern(const std::string& option, const std::string& expression);

  bool matches(const std::string& channel) const;

 private:
  struct Free {
    void operator()(regex_t* expression) const;
  };
  std::unique_ptr<regex_t, Free> expression_;
};

}  // namespace nao
