#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

namespace nao {

/** Name of a locale whose numbers have a decimal comma. */
inline constexpr char kDecimalComma[] = "de_DE.UTF-8";

/** Makes that locale in a folder, for the environment variable LOCPATH.
 * @return false without localedef and its sources (package locales). */
inline bool make_decimal_comma(const std::filesystem::path& folder) {
  const std::string command =
      "localedef -i de_DE -f UTF-8 '" + (folder / kDecimalComma).string() + "' >/dev/null 2>&1";
  return std::system(command.c_str()) == 0;
}

}  // namespace nao
