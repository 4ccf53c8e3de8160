#include "common/json_writer.h"

#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

namespace nao {

using Json = nlohmann::ordered_json;

struct JsonWriter::Document {
  Json root;
  /** The unfinished objects and arrays, outermost first. The pointers stay valid: values are added
   * to the innermost one only, so that no other container reallocates. */
  std::vector<Json*> open;

  Json& add(const std::string& key, Json value) {
    if (open.empty()) return root = std::move(value);
    Json& container = *open.back();
    if (container.is_array()) {
      container.push_back(std::move(value));
      return container.back();
    }
    return container[key] = std::move(value);
  }
};

JsonWriter::JsonWriter() : document_(std::make_unique<Document>()) {}
JsonWriter::~JsonWriter() = default;

void JsonWriter::begin_object(const std::string& key) {
  document_->open.push_back(&document_->add(key, Json::object()));
}

void JsonWriter::begin_array(const std::string& key) {
  document_->open.push_back(&document_->add(key, Json::array()));
}

void JsonWriter::end() {
  document_->open.pop_back();
}

void JsonWriter::add(const std::string& key, const std::string& value) {
  document_->add(key, value);
}

void JsonWriter::add(const std::string& key, bool value) {
  document_->add(key, value);
}

void JsonWriter::add(const std::string& key, int64_t value) {
  document_->add(key, value);
}

void JsonWriter::add(const std::string& key, double value) {
  document_->add(key, value);
}

void JsonWriter::add(const std::string& key, const double* values, int num_values) {
  begin_array(key);
  for (int i = 0; i < num_values; ++i) add("", values[i]);
  end();
}

void JsonWriter::add_null(const std::string& key) {
  document_->add(key, nullptr);
}

std::string JsonWriter::text() const {
  constexpr int kOneLine = -1;  // an indent of the JSON library
  return document_->root.dump(kOneLine, ' ', false, Json::error_handler_t::replace);
}

}  // namespace nao
