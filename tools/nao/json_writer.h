#pragma once

#include <string>
#include <vector>

namespace nao {

/** Writes one JSON value, on one line. Inside an object every call names a key; inside an array,
 * and for the outermost value, the key is "". */
class JsonWriter {
 public:
  void begin_object(const std::string& key = "") { begin(key, '{', '}'); }
  void begin_array(const std::string& key = "") { begin(key, '[', ']'); }
  /** Ends the innermost object or array. */
  void end();

  void add(const std::string& key, const std::string& value);
  void add(const std::string& key, const char* value) { add(key, std::string(value)); }
  void add(const std::string& key, bool value) { add_raw(key, value ? "true" : "false"); }
  void add(const std::string& key, int value) { add_raw(key, std::to_string(value)); }
  void add(const std::string& key, long value) { add_raw(key, std::to_string(value)); }
  /** A number that is not finite becomes null; others keep all their digits. */
  void add(const std::string& key, double value);
  void add(const std::string& key, const double* values, int num_values);

  const std::string& text() const { return text_; }

 private:
  void begin(const std::string& key, char opening, char closing);
  void add_raw(const std::string& key, const std::string& text);

  std::string text_;
  std::vector<char> closings_;
  bool needs_comma_ = false;
};

}  // namespace nao
