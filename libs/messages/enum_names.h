#pragma once

#include <array>
#include <cstddef>

namespace nao {

/** Name of an enum's value in a table by its number; "unknown" beyond it. */
template <class Name, size_t n, class Enum>
Name name_in(const std::array<Name, n>& names, Enum value) {
  const auto index = static_cast<size_t>(value);
  return index < n ? names[index] : "unknown";
}

}  // namespace nao
