#include "tools/nao/json_writer.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>

namespace nao {
namespace {

std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      result += '\\';
      result += c;
    } else if (static_cast<unsigned char>(c) < 0x20) {
      std::array<char, 8> escape{};
      std::snprintf(escape.data(), escape.size(), "\\u%04x", static_cast<unsigned>(c));
      result += escape.data();
    } else {
      result += c;
    }
  }
  return result + '"';
}

}  // namespace

void JsonWriter::begin(const std::string& key, char opening, char closing) {
  add_raw(key, std::string(1, opening));
  closings_.push_back(closing);
  needs_comma_ = false;
}

void JsonWriter::end() {
  text_ += closings_.back();
  closings_.pop_back();
  needs_comma_ = true;
}

void JsonWriter::add(const std::string& key, const std::string& value) {
  add_raw(key, quoted(value));
}

void JsonWriter::add(const std::string& key, double value) {
  std::array<char, 32> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
  add_raw(key, std::isfinite(value) ? std::string(digits.data(), end) : "null");
}

void JsonWriter::add(const std::string& key, const double* values, int num_values) {
  begin_array(key);
  for (int i = 0; i < num_values; ++i) add("", values[i]);
  end();
}

void JsonWriter::add_raw(const std::string& key, const std::string& text) {
  if (needs_comma_) text_ += ", ";
  if (!closings_.empty() && closings_.back() == '}') text_ += quoted(key) + ": ";
  text_ += text;
  needs_comma_ = true;
}

}  // namespace nao
