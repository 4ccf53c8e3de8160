#pragma once

#include <cstdint>
#include <memory>
#include <string>

namespace nao {

/** Builds one JSON value, field by field. Inside an object every call names a key; inside an array,
 * and for the outermost value, the key is "".
 *
 * The implementation is nlohmann-json. Only json_writer.cpp includes its header, which takes
 * several seconds to compile. */
class JsonWriter {
 public:
  JsonWriter();
  ~JsonWriter();
  JsonWriter(const JsonWriter&) = delete;
  JsonWriter& operator=(const JsonWriter&) = delete;

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

  /** The value on one line, keys in the order of the calls. Bytes that are not UTF-8 become U+FFFD.
   */
  std::string text() const;

 private:
  struct Document;
  std::unique_ptr<Document> document_;
};

}  // namespace nao
