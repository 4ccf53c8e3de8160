#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace nao {

/** Name of an enum's value in a table by its number; "unknown" beyond it. */
template <size_t n, class Enum>
std::string_view name_in(const std::array<std::string_view, n>& names, Enum value) {
  const auto index = static_cast<size_t>(value);
  return index < n ? names[index] : "unknown";
}

}  // namespace nao
