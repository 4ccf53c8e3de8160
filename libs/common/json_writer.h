#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace nao {

/** Writes one JSON value, field by field. Inside an object every call names a key, each once;
 * inside an array, and for the outermost value, the key is "".
 *
 * Text is appended as it comes: programs write some 10^5 numbers a second. Bytes beyond ASCII go
 * through nlohmann-json, whose header only json_writer.cpp includes. */
class JsonWriter {
 public:
  void begin_object(const std::string& key = "");
  void begin_array(const std::string& key = "");
  /** Ends the innermost object or array. */
  void end();

  void add(const std::string& key, const std::string& value);
  void add(const std::string& key, const char* value) { add(key, std::string(value)); }
  void add(const std::string& key, bool value);
  void add(const std::string& key, int value) { add(key, static_cast<int64_t>(value)); }
  void add(const std::string& key, int64_t value);
  /** A non-finite number becomes null; others are written with the digits that identify them. */
  void add(const std::string& key, double value);
  void add(const std::string& key, const double* values, int num_values);
  void add_null(const std::string& key);
  /** Bytes as a string in base64 (RFC 4648, section 4). */
  void add_base64(const std::string& key, std::span<const uint8_t> bytes);
  /** A value that is JSON already. */
  void add_json(const std::string& key, const std::string& json);

  /** Ends what is unfinished. @return The value on one line, keys in the order of the calls; bytes
   * that are not UTF-8 are U+FFFD. Nothing can be added afterwards. */
  std::string take();

 private:
  /** Writes what comes before a value: comma and key. */
  void begin_value(const std::string& key);
  void write_string(const std::string& value);

  std::string text_;
  /** The last letters of the unfinished objects and arrays, outermost first. */
  std::vector<char> ends_;
  /** The next value is the first of its object or array. */
  bool is_first_ = true;
};

}  // namespace nao
