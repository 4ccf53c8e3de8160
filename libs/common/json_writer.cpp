#include "common/json_writer.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string_view>

namespace nao {
namespace {

/** Whether a string stands for itself between quotes (RFC 8259, section 7). */
bool is_plain(const std::string& text) {
  return std::all_of(text.begin(), text.end(), [](char letter) {
    const auto code = static_cast<unsigned char>(letter);
    return code >= 0x20 && code < 0x80 && letter != '"' && letter != '\\';
  });
}

}  // namespace

void JsonWriter::begin_value(const std::string& key) {
  if (!is_first_) text_ += ',';
  is_first_ = false;
  if (!ends_.empty() && ends_.back() == '}') {
    write_string(key);
    text_ += ':';
  }
}

void JsonWriter::write_string(const std::string& value) {
  if (is_plain(value)) {
    text_ += '"';
    text_ += value;
    text_ += '"';
  } else {
    constexpr int kOneLine = -1;  // an indent of the JSON library
    text_ +=
        nlohmann::json(value).dump(kOneLine, ' ', false, nlohmann::json::error_handler_t::replace);
  }
}

void JsonWriter::begin_object(const std::string& key) {
  begin_value(key);
  text_ += '{';
  ends_.push_back('}');
  is_first_ = true;
}

void JsonWriter::begin_array(const std::string& key) {
  begin_value(key);
  text_ += '[';
  ends_.push_back(']');
  is_first_ = true;
}

void JsonWriter::end() {
  text_ += ends_.back();
  ends_.pop_back();
  is_first_ = false;
}

std::string JsonWriter::take() {
  while (!ends_.empty()) end();
  return std::move(text_);
}

void JsonWriter::add(const std::string& key, const std::string& value) {
  begin_value(key);
  write_string(value);
}

void JsonWriter::add(const std::string& key, bool value) {
  begin_value(key);
  text_ += value ? "true" : "false";
}

void JsonWriter::add(const std::string& key, int64_t value) {
  begin_value(key);
  std::array<char, 24> digits;
  text_.append(digits.data(), std::to_chars(digits.begin(), digits.end(), value).ptr);
}

void JsonWriter::add(const std::string& key, double value) {
  if (!std::isfinite(value)) return add_null(key);
  begin_value(key);
  // The longest one is -2.2250738585072014e-308.
  std::array<char, 32> digits;
  const std::string_view number(
      digits.data(), std::to_chars(digits.begin(), digits.end(), value).ptr - digits.data());
  text_ += number;
  // Tells readers with an integer type that this is none.
  if (number.find_first_of(".e") == std::string_view::npos) text_ += ".0";
}

void JsonWriter::add(const std::string& key, const double* values, int num_values) {
  begin_array(key);
  for (int i = 0; i < num_values; ++i) add("", values[i]);
  end();
}

void JsonWriter::add_null(const std::string& key) {
  begin_value(key);
  text_ += "null";
}

void JsonWriter::add_base64(const std::string& key, std::span<const uint8_t> bytes) {
  static constexpr char kDigits[] =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  begin_value(key);
  text_.reserve(text_.size() + (bytes.size() + 2) / 3 * 4 + 2);
  text_ += '"';
  const size_t whole = bytes.size() / 3 * 3;
  for (size_t i = 0; i < whole; i += 3) {
    const uint32_t group = uint32_t{bytes[i]} << 16 | uint32_t{bytes[i + 1]} << 8 | bytes[i + 2];
    const std::array<char, 4> letters{kDigits[group >> 18], kDigits[group >> 12 & 63],
                                      kDigits[group >> 6 & 63], kDigits[group & 63]};
    text_.append(letters.data(), letters.size());
  }
  // One or two bytes are left: filled up with zero bits, then with "=".
  if (const size_t left = bytes.size() - whole; left > 0) {
    const uint32_t group =
        uint32_t{bytes[whole]} << 16 | (left == 2 ? uint32_t{bytes[whole + 1]} << 8 : 0);
    text_ += kDigits[group >> 18];
    text_ += kDigits[group >> 12 & 63];
    text_ += left == 2 ? kDigits[group >> 6 & 63] : '=';
    text_ += '=';
  }
  text_ += '"';
}

void JsonWriter::add_json(const std::string& key, const std::string& json) {
  begin_value(key);
  text_ += json;
}

}  // namespace nao
