#pragma once

#include <fmt/core.h>

#include <string>

/** Log of the program: lines on stderr. Behind it stands spdlog, whose headers only logger.cpp
 * reads: its calls cost seconds in each file that has one. */
namespace nao::logger {

enum class Level { kInfo, kWarning, kError };

/** @param level  Least severe line to print: trace, debug, info, warning, error. */
void set_up(const std::string& program, const std::string& level);

void write(Level level, fmt::string_view format, fmt::format_args arguments);

template <class... Arguments>
void info(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
  write(Level::kInfo, format, fmt::make_format_args(arguments...));
}

template <class... Arguments>
void warn(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
  write(Level::kWarning, format, fmt::make_format_args(arguments...));
}

template <class... Arguments>
void error(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
  write(Level::kError, format, fmt::make_format_args(arguments...));
}

}  // namespace nao::logger
