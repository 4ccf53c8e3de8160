#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace nao {

/** "a, b, c": the names of items. @param name_of  Function or member that gives an item's name. */
template <class Items, class NameOf = std::identity>
std::string joined(const Items& items, NameOf name_of = {}, std::string_view separator = ", ") {
  std::string list;
  for (const auto& item : items) {
    if (!list.empty()) list += separator;
    list += std::invoke(name_of, item);
  }
  return list;
}

}  // namespace nao
