#pragma once

#include <string>

namespace nao {

/** A name in YAML: quoted, for names may contain anything. */
inline std::string in_yaml(const std::string& name) {
  std::string text = "\"";
  for (const char c : name) {
    if (c == '"' || c == '\\') text += '\\';
    text += c;
  }
  return text + "\"";
}

}  // namespace nao
