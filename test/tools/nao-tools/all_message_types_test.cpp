// Claims about every message type, checked by reflection: no list of types needs to be maintained.

#include "all_message_types.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <vector>

#include "common/json_text.h"
#include "inspection/message_json.h"
#include "message_reflection/message_layout.h"
#include "message_reflection/message_types.h"
#include "messages/command.h"
#include "messages/mode.h"
#include "tools/nao-tools/channel_statistics.h"

namespace nao {
namespace {

using Bytes = std::vector<uint8_t>;
using Json = nlohmann::json;

/** Encodes random messages from their layouts, without the C++ types. Source of the wire format:
 * LCM's documentation, "type specification language". */
class RandomEncoder {
 public:
  explicit RandomEncoder(uint32_t seed) : random_(seed) {}

  Bytes encode(const MessageType& type) {
    bytes_.clear();
    add_big_endian(static_cast<uint64_t>(type.fingerprint), 8);
    add_struct(*find_message_layout(type.name));
    return bytes_;
  }

 private:
  void add_big_endian(uint64_t value, size_t size) {
    for (size_t i = size; i-- > 0;) bytes_.push_back(static_cast<uint8_t>(value >> (8 * i)));
  }

  void add_struct(const MessageLayout& layout) {
    std::map<std::string, int64_t> lengths;
    for (const FieldLayout& field : layout.fields) {
      for (const std::string& dimension : field.dimensions) {
        if (std::isdigit(static_cast<unsigned char>(dimension[0])) != 0) {
          lengths[dimension] = std::stoll(dimension);
        } else {
          // At least 1, so that the content of every array is checked.
          lengths.try_emplace(dimension, 1 + static_cast<int64_t>(random_() % 3));
        }
      }
    }
    for (const FieldLayout& field : layout.fields) add_dimension(field, 0, lengths);
  }

  void add_dimension(const FieldLayout& field, size_t depth,
                     const std::map<std::string, int64_t>& lengths) {
    if (depth == field.dimensions.size()) {
      const auto length = lengths.find(field.name);
      const bool is_length = depth == 0 && length != lengths.end();
      return is_length ? add_integer(field, static_cast<uint64_t>(length->second))
                       : add_value(field);
    }
    const int64_t length = lengths.at(field.dimensions[depth]);
    for (int64_t i = 0; i < length; ++i) add_dimension(field, depth + 1, lengths);
  }

  void add_value(const FieldLayout& field) {
    switch (field.kind) {
      case FieldKind::kFloat:
        return add_big_endian(std::bit_cast<uint32_t>(static_cast<float>(random_()) * 1e-3f), 4);
      case FieldKind::kDouble:
        return add_big_endian(std::bit_cast<uint64_t>(static_cast<double>(random_()) * 1e-3), 8);
      case FieldKind::kBoolean:
        return add_big_endian(random_() % 2, 1);
      case FieldKind::kString:
        return add_text();
      case FieldKind::kStruct:
        return add_struct(*find_message_layout(field.type));
      default:
        if (field.constants.empty()) return add_integer(field, random_());
        const auto index = random_() % field.constants.size();
        return add_integer(field, static_cast<uint64_t>(field.constants[index].value));
    }
  }

  void add_integer(const FieldLayout& field, uint64_t value) {
    switch (field.kind) {
      case FieldKind::kInt16:
        return add_big_endian(value, 2);
      case FieldKind::kInt32:
        return add_big_endian(value, 4);
      case FieldKind::kInt64:
        return add_big_endian(value, 8);
      default:
        return add_big_endian(value, 1);
    }
  }

  /** A string: 32-bit length with the final zero, the characters, the zero. */
  void add_text() {
    const size_t length = random_() % 6;
    add_big_endian(length + 1, 4);
    for (size_t i = 0; i < length; ++i) add_big_endian('a' + random_() % 26, 1);
    add_big_endian(0, 1);
  }

  std::mt19937 random_;
  Bytes bytes_;
};

/** Decodes a message with its C++ type and encodes it again; empty if it does not decode. */
template <class Message>
Bytes reencode(const Bytes& bytes) {
  Message message;
  const int size = static_cast<int>(bytes.size());
  if (message.decode(bytes.data(), 0, size) != size) return {};
  Bytes result(message.getEncodedSize());
  message.encode(result.data(), 0, static_cast<int>(result.size()));
  return result;
}

const std::map<std::string, std::function<Bytes(const Bytes&)>> kReencoders{
#define NAO_REENCODER(type) {#type, &reencode<naolcm::type>},
    NAO_FOR_EACH_MESSAGE_TYPE(NAO_REENCODER)
#undef NAO_REENCODER
};

/** Calls `check` with a few random messages of every type. */
void for_each_message(const std::function<void(const MessageType&, const Bytes&)>& check) {
  RandomEncoder encoder(1);
  ASSERT_FALSE(message_types().empty());
  for (const MessageType& type : message_types()) {
    SCOPED_TRACE(type.name);
    for (int i = 0; i < 10; ++i) check(type, encoder.encode(type));
  }
}

/** First value of an array of any dimensions, or the value itself. */
const Json& first_value(const Json& value) {
  return value.is_array() && !value.empty() ? first_value(value.front()) : value;
}

/** Compares the keys of a JSON object with the fields of its type. */
void expect_all_fields(const Json& object, const MessageLayout& layout) {
  size_t num_keys = layout.fields.size();
  for (const FieldLayout& field : layout.fields) {
    SCOPED_TRACE(field.name);
    ASSERT_TRUE(object.contains(field.name));
    const Json& value = first_value(object[field.name]);
    if (field.kind == FieldKind::kStruct) {
      expect_all_fields(value, *find_message_layout(field.type));
    }
    if (field.constants.empty()) continue;
    ++num_keys;
    ASSERT_TRUE(object.contains(field.name + "_name"));
    const std::string* name = find_constant_name(field, value.get<int64_t>());
    ASSERT_NE(name, nullptr);
    EXPECT_EQ(first_value(object[field.name + "_name"]), *name);
  }
  EXPECT_EQ(object.size(), num_keys);
}

TEST(AllMessageTypes, DecodeAndEncodeToTheSameBytes) {
  for_each_message([](const MessageType& type, const Bytes& bytes) {
    EXPECT_TRUE(type.decodes(bytes.data(), static_cast<int>(bytes.size())));
    ASSERT_TRUE(kReencoders.contains(type.name));
    EXPECT_EQ(kReencoders.at(type.name)(bytes), bytes);
  });
}

TEST(AllMessageTypes, AreRecognizedByTheChannelStatistics) {
  ChannelStatistics statistics;
  for_each_message([&](const MessageType& type, const Bytes& bytes) {
    statistics.add(type.name, bytes.data(), static_cast<int>(bytes.size()), 0);
    EXPECT_EQ(statistics.channels().at(type.name).type, type.name);
  });
  EXPECT_EQ(statistics.num_undecodable(), 0);
}

TEST(AllMessageTypes, HaveEveryFieldAndEnumerationNameInJson) {
  for_each_message([](const MessageType& type, const Bytes& bytes) {
    const MessageLayout& layout = *find_message_layout(type.name);
    const auto text = message_to_json(layout, bytes);
    ASSERT_TRUE(text);
    expect_all_fields(parse_json(*text), layout);
  });
}

TEST(AllMessageTypes, HaveASchemaOfEveryFieldThatFoxgloveReads) {
  for (const MessageLayout& layout : message_layouts()) {
    const Json schema = parse_json(json_schema_of(layout));
    EXPECT_EQ(schema["title"], "naolcm." + layout.name);
    for (const FieldLayout& field : layout.fields) {
      SCOPED_TRACE(layout.name + "." + field.name);
      // Foxglove refuses a channel whose schema has a list of lists.
      ASSERT_EQ(schema["properties"].contains(field.name), field.dimensions.size() < 2);
      EXPECT_EQ(schema["properties"].contains(field.name + "_name"), !field.constants.empty());
    }
    for (const auto& [name, property] : schema["properties"].items()) {
      SCOPED_TRACE(layout.name + "." + name);
      ASSERT_TRUE(property.contains("type"));
      if (property["type"] != "array") continue;
      ASSERT_TRUE(property["items"].contains("type"));
      EXPECT_NE(property["items"]["type"], "array");
    }
  }
}

TEST(AllMessageTypes, AreDocumentedFieldByField) {
  for (const MessageLayout& layout : message_layouts()) {
    EXPECT_FALSE(layout.description.empty()) << layout.name;
    for (const FieldLayout& field : layout.fields) {
      EXPECT_FALSE(field.description.empty()) << layout.name << "." << field.name;
    }
  }
}

TEST(AllMessageTypes, AreNamedInTheReadme) {
  std::ifstream file(NAO_LCMTYPES_README);
  const std::string readme((std::istreambuf_iterator<char>(file)), {});
  for (const MessageLayout& layout : message_layouts()) {
    EXPECT_NE(readme.find("`" + layout.name + "`"), std::string::npos) << layout.name;
  }
}

TEST(AllMessageTypes, GiveAConstantOfOneNameOneValue) {
  std::map<std::string, int64_t> values;
  for (const MessageLayout& layout : message_layouts()) {
    for (const FieldLayout& field : layout.fields) {
      for (const EnumConstant& constant : field.constants) {
        const bool is_shared = constant.name.starts_with("COMMAND_KIND_") ||
                               constant.name.starts_with("BEHAVIOR_") ||
                               constant.name.starts_with("ROLE_");
        if (!is_shared) continue;
        const auto [entry, is_new] = values.try_emplace(constant.name, constant.value);
        EXPECT_EQ(entry->second, constant.value) << layout.name << ": " << constant.name;
      }
    }
  }
  EXPECT_FALSE(values.empty());
}

/** The constant that to_string() of a C++ enumeration corresponds to: "MODE_GETTING_UP". */
std::string constant_name(const std::string& prefix, std::string name) {
  std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) {
    return c == '-' ? '_' : static_cast<char>(std::toupper(c));
  });
  return prefix + name;
}

const FieldLayout& find_field(const std::string& type, const std::string& name) {
  const auto& fields = find_message_layout(type)->fields;
  return *std::find_if(fields.begin(), fields.end(),
                       [&](const FieldLayout& field) { return field.name == name; });
}

template <class Enumeration>
void expect_equal_values(const std::string& type, const std::string& field,
                         const std::string& prefix, int num_values) {
  for (int value = 0; value < num_values; ++value) {
    const std::string* name = find_constant_name(find_field(type, field), value);
    ASSERT_NE(name, nullptr) << field << " " << value;
    EXPECT_EQ(*name, constant_name(prefix, to_string(static_cast<Enumeration>(value))));
  }
}

TEST(AllMessageTypes, AgreeWithTheEnumerationsInCpp) {
  expect_equal_values<CommandKind>("command_result_t", "command_kind", "COMMAND_KIND_",
                                   kNumCommandKinds);
  expect_equal_values<CommandKind>("motion_state_t", "command_kind", "COMMAND_KIND_",
                                   kNumCommandKinds);
  expect_equal_values<ResultStatus>("command_result_t", "status", "STATUS_",
                                    static_cast<int>(ResultStatus::kFailed) + 1);
  expect_equal_values<Mode>("motion_state_t", "mode", "MODE_", kNumModes);
}

}  // namespace
}  // namespace nao
