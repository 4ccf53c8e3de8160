#include "inspection/message_json.h"

#include "common/json_writer.h"
#include "message_reflection/message_walk.h"

namespace nao {
namespace {

/** Key of the name that belongs to an enumeration's value: "status_name" for "status". */
std::string name_key(const std::string& key) {
  return key + "_name";
}

/** Writes a message into an open JSON object. */
class JsonMessageWriter : public MessageVisitor {
 public:
  explicit JsonMessageWriter(JsonWriter& json) : json_(json) {}
  void begin_struct(const std::string& key) override {
    json_.begin_object(key);
    containers_.emplace_back();
  }
  void end_struct() override {
    json_.end();
    containers_.pop_back();
  }
  void begin_list(const std::string& key) override {
    json_.begin_array(key);
    containers_.push_back({true, key, {}, false});
  }
  void end_list() override {
    json_.end();
    const Container list = std::move(containers_.back());
    containers_.pop_back();
    if (!list.has_names) return;
    json_.begin_array(name_key(list.key));
    for (const std::string& name : list.names) {
      if (name.empty()) {
        json_.add_null("");
      } else {
        json_.add("", name);
      }
    }
    json_.end();
  }
  void integer(const std::string& key, int64_t value) override {
    json_.add(key, value);
    if (containers_.back().is_list) containers_.back().names.emplace_back();
  }
  void enumerator(const std::string& key, int64_t value, const std::string& constant) override {
    integer(key, value);
    if (containers_.back().is_list) {
      containers_.back().names.back() = constant;
      containers_.back().has_names = true;
    } else {
      json_.add(name_key(key), constant);
    }
  }
  void number(const std::string& key, double value) override { json_.add(key, value); }
  void boolean(const std::string& key, bool value) override { json_.add(key, value); }
  void text(const std::string& key, const std::string& value) override { json_.add(key, value); }
  void bytes(const std::string& key, std::span<const uint8_t> value) override {
    json_.add_base64(key, value);
  }

 private:
  /** An enclosing struct or array. */
  struct Container {
    bool is_list = false;
    std::string key;
    /** Constant of each integer of an array; "" where no constant has its value. */
    std::vector<std::string> names;
    bool has_names = false;
  };

  JsonWriter& json_;
  /** The enclosing structs and arrays, outermost first; the message itself is the first. */
  std::vector<Container> containers_ = std::vector<Container>(1);
};

void add_schema_fields(JsonWriter& json, const MessageLayout& layout);

void add_schema_of_value(JsonWriter& json, const FieldLayout& field) {
  switch (field.kind) {
    case FieldKind::kFloat:
    case FieldKind::kDouble:
      json.add("type", "number");
      // Numbers that are not finite become null.
      json.add("nullable", true);
      return;
    case FieldKind::kBoolean:
      json.add("type", "boolean");
      return;
    case FieldKind::kString:
      json.add("type", "string");
      return;
    case FieldKind::kStruct:
      add_schema_fields(json, *find_message_layout(field.type));
      return;
    default:
      json.add("type", "integer");
  }
}

void add_schema_of_field(JsonWriter& json, const FieldLayout& field) {
  if (field.dimensions.empty()) return add_schema_of_value(json, field);
  if (field.kind == FieldKind::kByte) {
    json.add("type", "string");
    json.add("contentEncoding", "base64");
    return;
  }
  json.add("type", "array");
  json.begin_object("items");
  add_schema_of_value(json, field);
  json.end();
}

/** The property that holds the names of an enumeration's values. Only one-dimensional arrays of
 * enumerations exist. */
void add_schema_of_names(JsonWriter& json, const FieldLayout& field) {
  const bool is_list = !field.dimensions.empty();
  json.begin_object(name_key(field.name));
  if (is_list) {
    json.add("type", "array");
    json.begin_object("items");
  }
  json.add("type", "string");
  // An element of an array may have a value without a name.
  if (is_list) json.add("nullable", true);
  json.begin_array("enum");
  for (const EnumConstant& constant : field.constants) json.add("", constant.name);
  if (is_list) json.add_null("");
  json.end();
  if (is_list) json.end();
  json.add("description",
           "Name of the constant that " + field.name + " equals; absent if none does.");
  json.end();
}

bool is_array_of_arrays(const FieldLayout& field) {
  return field.dimensions.size() > 1;
}

void add_schema_fields(JsonWriter& json, const MessageLayout& layout) {
  json.add("type", "object");
  json.begin_object("properties");
  for (const FieldLayout& field : layout.fields) {
    if (is_array_of_arrays(field)) continue;
    json.begin_object(field.name);
    add_schema_of_field(json, field);
    json.add("description", field.description);
    json.end();
    if (!field.constants.empty()) add_schema_of_names(json, field);
  }
  json.end();
  json.begin_array("required");
  for (const FieldLayout& field : layout.fields) {
    if (!is_array_of_arrays(field)) json.add("", field.name);
  }
  json.end();
}

}  // namespace

std::optional<std::string> message_to_json(const MessageLayout& layout,
                                           std::span<const uint8_t> message) {
  JsonWriter json;
  json.begin_object();
  JsonMessageWriter writer(json);
  if (!walk_message(layout, message, writer)) return {};
  return json.take();
}

std::string json_schema_of(const MessageLayout& layout) {
  JsonWriter json;
  json.begin_object();
  json.add("$schema", "https://json-schema.org/draft/2020-12/schema");
  json.add("title", "naolcm." + layout.name);
  json.add("description", layout.description);
  add_schema_fields(json, layout);
  return json.take();
}

}  // namespace nao
