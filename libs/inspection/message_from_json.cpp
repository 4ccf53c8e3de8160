#include "inspection/message_from_json.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cstdint>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>

namespace nao {
namespace {

using Json = nlohmann::json;

/** Fault of a field. It ends the encoding; message_from_json() returns its text. */
class Fault : public std::runtime_error {
 public:
  Fault(const std::string& path, const std::string& what)
      : std::runtime_error("Field \"" + path + "\" " + what) {}
};

// Largest number of elements that an absent array of fixed length is filled with. Chosen: no
// message has a longer one.
constexpr int64_t kMaxFixedLength = 1000;

/** Appends LCM's wire format: see message_walk.cpp. */
class WireWriter {
 public:
  void big_endian(uint64_t value, int size) {
    for (int i = size - 1; i >= 0; --i) bytes_.push_back(static_cast<uint8_t>(value >> (8 * i)));
  }
  void text(const std::string& value) {
    big_endian(value.size() + 1, 4);
    bytes_.insert(bytes_.end(), value.begin(), value.end());
    bytes_.push_back(0);
  }
  std::vector<uint8_t> take() { return std::move(bytes_); }

 private:
  std::vector<uint8_t> bytes_;
};

std::optional<int64_t> fixed_length(const std::string& dimension) {
  int64_t length = 0;
  const char* const end = dimension.data() + dimension.size();
  if (std::from_chars(dimension.data(), end, length).ptr != end) return std::nullopt;
  return length;
}

/** Encodes the fields of one struct. */
class StructEncoder {
 public:
  /** @param object  Null if the struct is absent. @param path  Path of the struct, "a." or "". */
  StructEncoder(const MessageLayout& layout, const Json* object, std::string path,
                WireWriter& writer)
      : layout_(layout), object_(object), path_(std::move(path)), writer_(writer) {}

  void encode() {
    check_names();
    for (const FieldLayout& field : layout_.fields) find_lengths(field, 0, find(field.name));
    for (const FieldLayout& field : layout_.fields) {
      const auto length = lengths_.find(field.name);
      if (length == lengths_.end()) {
        encode_dimension(field, 0, find(field.name), path_ + field.name);
      } else {
        encode_length(field, length->second);
      }
    }
  }

 private:
  const Json* find(const std::string& name) const {
    if (object_ == nullptr) return nullptr;
    const auto found = object_->find(name);
    return found == object_->end() ? nullptr : &*found;
  }

  void check_names() const {
    if (object_ == nullptr) return;
    for (const auto& item : object_->items()) {
      bool is_known = false;
      for (const FieldLayout& field : layout_.fields) {
        // message_to_json() adds the name of an enumeration's value.
        is_known = is_known || item.key() == field.name ||
                   (!field.constants.empty() && item.key() == field.name + "_name");
      }
      if (!is_known) throw Fault(path_ + item.key(), "does not exist in " + layout_.name + ".");
    }
  }

  /** Takes the lengths of an array's dimensions from its elements. */
  void find_lengths(const FieldLayout& field, size_t depth, const Json* value) {
    if (depth == field.dimensions.size()) return;
    const std::string& dimension = field.dimensions[depth];
    if (!fixed_length(dimension)) {
      const auto known = lengths_.try_emplace(dimension, -1).first;
      if (value != nullptr && value->is_array()) {
        const auto size = static_cast<int64_t>(value->size());
        if (known->second >= 0 && known->second != size) {
          throw Fault(path_ + field.name, "has " + std::to_string(size) +
                                              " entries where another has " +
                                              std::to_string(known->second) + ".");
        }
        known->second = size;
      }
    }
    const bool has_elements = value != nullptr && value->is_array() && !value->empty();
    find_lengths(field, depth + 1, has_elements ? &value->front() : nullptr);
  }

  void encode_length(const FieldLayout& field, int64_t found) {
    const int64_t length = std::max<int64_t>(0, found);
    const Json* const given = find(field.name);
    if (given != nullptr && *given != length) {
      throw Fault(path_ + field.name,
                  "is not the number of entries, " + std::to_string(length) + ".");
    }
    write_integer(field, length, path_ + field.name);
  }

  void encode_dimension(const FieldLayout& field, size_t depth, const Json* value,
                        const std::string& path) {
    if (depth == field.dimensions.size()) return encode_value(field, value, path);
    const auto fixed = fixed_length(field.dimensions[depth]);
    const int64_t length = std::max<int64_t>(0, fixed.value_or(lengths_[field.dimensions[depth]]));
    if (length > 0 && field.kind == FieldKind::kByte)
      throw Fault(path, "cannot be given: it is bytes.");
    if (value != nullptr && !value->is_array()) throw Fault(path, "is not a list.");
    const bool is_filled = value == nullptr && fixed && length <= kMaxFixedLength;
    if (!is_filled && (value == nullptr ? 0 : static_cast<int64_t>(value->size())) != length) {
      throw Fault(path, "needs " + std::to_string(length) + " entries.");
    }
    for (int64_t i = 0; i < length; ++i) {
      encode_dimension(field, depth + 1,
                       value == nullptr ? nullptr : &(*value)[static_cast<size_t>(i)],
                       path + "[" + std::to_string(i) + "]");
    }
  }

  void encode_value(const FieldLayout& field, const Json* value, const std::string& path) {
    switch (field.kind) {
      case FieldKind::kFloat:
        return writer_.big_endian(std::bit_cast<uint32_t>(static_cast<float>(number(value, path))),
                                  4);
      case FieldKind::kDouble:
        return writer_.big_endian(std::bit_cast<uint64_t>(number(value, path)), 8);
      case FieldKind::kBoolean:
        if (value != nullptr && !value->is_boolean())
          throw Fault(path, "is neither true nor false.");
        return writer_.big_endian(value != nullptr && value->get<bool>() ? 1 : 0, 1);
      case FieldKind::kString:
        return encode_text(value, path);
      case FieldKind::kStruct:
        if (value != nullptr && !value->is_object()) throw Fault(path, "is not an object.");
        return StructEncoder(*find_message_layout(field.type), value, path + ".", writer_).encode();
      default:
        return write_integer(field, integer(field, value, path), path);
    }
  }

  static double number(const Json* value, const std::string& path) {
    if (value == nullptr) return 0;
    if (value->is_null()) return std::numeric_limits<double>::quiet_NaN();
    if (!value->is_number()) throw Fault(path, "is not a number.");
    return value->get<double>();
  }

  void encode_text(const Json* value, const std::string& path) {
    if (value != nullptr && !value->is_string()) throw Fault(path, "is not text.");
    const std::string text = value == nullptr ? "" : value->get<std::string>();
    // LCM ends texts with a zero.
    if (text.find('\0') != std::string::npos) throw Fault(path, "contains a zero character.");
    writer_.text(text);
  }

  static int64_t integer(const FieldLayout& field, const Json* value, const std::string& path) {
    if (value == nullptr) return 0;
    if (value->is_string()) {
      for (const EnumConstant& constant : field.constants) {
        if (*value == constant.name) return constant.value;
      }
      throw Fault(path, "has no constant of this name.");
    }
    if (!value->is_number_integer()) throw Fault(path, "is not an integer.");
    if (value->is_number_unsigned() &&
        value->get<uint64_t>() > static_cast<uint64_t>(std::numeric_limits<int64_t>::max())) {
      throw Fault(path, "is out of range.");
    }
    return value->get<int64_t>();
  }

  void write_integer(const FieldLayout& field, int64_t value, const std::string& path) {
    const auto write = [&](int64_t lowest, int64_t highest, int size) {
      if (value < lowest || value > highest) throw Fault(path, "is out of range.");
      writer_.big_endian(static_cast<uint64_t>(value), size);
    };
    switch (field.kind) {
      case FieldKind::kInt8:
        return write(INT8_MIN, INT8_MAX, 1);
      case FieldKind::kByte:
        return write(0, UINT8_MAX, 1);
      case FieldKind::kInt16:
        return write(INT16_MIN, INT16_MAX, 2);
      case FieldKind::kInt32:
        return write(INT32_MIN, INT32_MAX, 4);
      default:
        return write(INT64_MIN, INT64_MAX, 8);
    }
  }

  const MessageLayout& layout_;
  const Json* object_;
  std::string path_;
  WireWriter& writer_;
  /** Length by the name of its field; -1 until an array gives it. */
  std::map<std::string, int64_t> lengths_;
};

}  // namespace

EncodedMessage message_from_json(const MessageType& type, const MessageLayout& layout,
                                 const Json& object) {
  if (!object.is_object()) return {{}, "The message is no JSON object."};
  WireWriter writer;
  writer.big_endian(static_cast<uint64_t>(type.fingerprint), 8);
  try {
    StructEncoder(layout, &object, "", writer).encode();
  } catch (const Fault& fault) {
    return {{}, fault.what()};
  }
  return {writer.take(), ""};
}

}  // namespace nao
