#include "inspection/foxglove_schemas.h"

#include <string_view>

#include "common/error.h"
#include "common/json_writer.h"
#include "common/yaml_entry.h"
#include "foxglove_texts.h"

namespace nao {
namespace {

constexpr std::string_view kOptional = "optional ";

std::string without_optional(const std::string& type) {
  return type.starts_with(kOptional) ? type.substr(kOptional.size()) : type;
}

/** Adds the JSON Schema of a type of foxglove_schemas.yaml, or of a list of one. */
void add_schema(JsonWriter& json, const std::string& key, const YamlEntry& types,
                const YamlEntry& type) {
  json.begin_object(key);
  const std::string name = type.is_list() ? "" : without_optional(type.text());
  if (type.is_list()) {
    json.add("type", "array");
    add_schema(json, "items", types, type.items().front());
  } else if (name == "base64") {
    json.add("type", "string");
    json.add("contentEncoding", "base64");
  } else if (!types.has(name)) {
    json.add("type", name);
  } else {
    json.add("title", name);
    json.add("type", "object");
    json.begin_object("properties");
    const auto fields = types.at(name).entries();
    for (const auto& [field, its_type] : fields) add_schema(json, field, types, its_type);
    json.end();
    json.begin_array("required");
    for (const auto& [field, its_type] : fields) {
      const bool is_optional = !its_type.is_list() && its_type.text().starts_with(kOptional);
      if (!is_optional) json.add("", field);
    }
    json.end();
  }
  json.end();
}

}  // namespace

std::string foxglove_schema(const std::string& name) {
  const std::string text(kFoxgloveTexts.at("foxglove_schemas"));
  const auto types = YamlEntry::parse<ConfigError>(text, "foxglove_schemas.yaml");
  JsonWriter json;
  add_schema(json, "", types, YamlEntry::parse<ConfigError>(name, name));
  return json.take();
}

}  // namespace nao
