#include "message_reflection/message_walk.h"

#include <bit>
#include <charconv>
#include <map>
#include <vector>

namespace nao {
namespace {

// Bytes at the beginning of a message: hash of its type (LCM).
constexpr size_t kFingerprintSize = 8;

/** Reads LCM's wire format: big-endian numbers; strings as a 32-bit length, the characters and a
 * final zero, both counted in the length. After a read beyond the end is_good() is false, and every
 * further read gives zero. Source: LCM's documentation, "type specification language". */
class WireReader {
 public:
  explicit WireReader(std::span<const uint8_t> bytes) : rest_(bytes) {}

  bool is_good() const { return is_good_; }
  bool is_at_end() const { return rest_.empty(); }
  size_t size_left() const { return rest_.size(); }
  void fail() { is_good_ = false; }

  std::span<const uint8_t> take(size_t size) {
    if (!is_good_ || size > rest_.size()) {
      is_good_ = false;
      return {};
    }
    const auto taken = rest_.first(size);
    rest_ = rest_.subspan(size);
    return taken;
  }

  uint64_t big_endian(size_t size) {
    uint64_t value = 0;
    for (const uint8_t byte : take(size)) value = value << 8 | byte;
    return value;
  }

  std::string text() {
    const auto size = static_cast<int32_t>(big_endian(4));
    if (size < 1) is_good_ = false;
    // An invalid length reads nothing.
    const auto characters = take(is_good_ ? static_cast<size_t>(size) : 0);
    if (characters.empty() || characters.back() != 0) {
      is_good_ = false;
      return "";
    }
    return {characters.begin(), characters.end() - 1};
  }

 private:
  std::span<const uint8_t> rest_;
  bool is_good_ = true;
};

/** Reads one struct and passes its fields to a visitor. */
class StructWalk {
 public:
  StructWalk(const MessageLayout& layout, WireReader& reader, MessageVisitor& visitor)
      : layout_(layout), reader_(reader), visitor_(visitor) {}

  void walk() {
    for (const FieldLayout& field : layout_.fields) {
      // Each field in the order of the .lcm file; the wire format has neither names nor lengths of
      // fields.
      if (!reader_.is_good()) return;
      walk_dimension(field, 0, field.name);
    }
  }

 private:
  /** Reads the elements of one dimension of an array; after the last dimension, the value. */
  void walk_dimension(const FieldLayout& field, size_t depth, const std::string& key) {
    if (depth == field.dimensions.size()) {
      walk_value(field, key);
      return;
    }
    const std::string& dimension = field.dimensions[depth];
    const size_t length = length_of(dimension);
    if (field.kind == FieldKind::kByte) {
      visitor_.bytes(key, reader_.take(length));
      return;
    }
    // Every element takes at least one byte (no type is an empty struct), so a damaged length is
    // rejected before it causes a long loop.
    if (length > reader_.size_left()) return reader_.fail();
    visitor_.begin_list(key);
    // Entries of an array are labelled by the string array of the same dimension, such as joints by
    // joint_names.
    const std::vector<std::string>* names = depth == 0 ? find_names(field, dimension) : nullptr;
    for (size_t i = 0; i < length && reader_.is_good(); ++i) {
      const bool is_named = names != nullptr && i < names->size();
      walk_dimension(field, depth + 1, is_named ? (*names)[i] : std::to_string(i));
    }
    visitor_.end_list();
  }

  /** Entries of the string array that labels an array; nullptr if there is none. */
  const std::vector<std::string>* find_names(const FieldLayout& field,
                                             const std::string& dimension) const {
    const auto names = names_.find(dimension);
    return names == names_.end() || field.kind == FieldKind::kString ? nullptr : &names->second;
  }

  void walk_value(const FieldLayout& field, const std::string& key) {
    switch (field.kind) {
      case FieldKind::kInt8:
        return integer(field, key, static_cast<int8_t>(reader_.big_endian(1)));
      case FieldKind::kByte:
        return integer(field, key, static_cast<int64_t>(reader_.big_endian(1)));
      case FieldKind::kInt16:
        return integer(field, key, static_cast<int16_t>(reader_.big_endian(2)));
      case FieldKind::kInt32:
        return integer(field, key, static_cast<int32_t>(reader_.big_endian(4)));
      case FieldKind::kInt64:
        return integer(field, key, static_cast<int64_t>(reader_.big_endian(8)));
      case FieldKind::kFloat:
        return visitor_.number(key,
                               std::bit_cast<float>(static_cast<uint32_t>(reader_.big_endian(4))));
      case FieldKind::kDouble:
        return visitor_.number(key, std::bit_cast<double>(reader_.big_endian(8)));
      case FieldKind::kBoolean:
        return visitor_.boolean(key, reader_.big_endian(1) != 0);
      case FieldKind::kString:
        return text(field, key);
      case FieldKind::kStruct:
        return walk_struct(field, key);
    }
  }

  void integer(const FieldLayout& field, const std::string& key, int64_t value) {
    // May be the length of an array that follows.
    if (field.dimensions.empty()) lengths_[field.name] = value;
    const std::string* constant = find_constant_name(field, value);
    if (constant != nullptr) {
      visitor_.enumerator(key, value, *constant);
    } else {
      visitor_.integer(key, value);
    }
  }

  void text(const FieldLayout& field, const std::string& key) {
    const std::string value = reader_.text();
    if (field.dimensions.size() == 1) names_[field.dimensions[0]].push_back(value);
    visitor_.text(key, value);
  }

  void walk_struct(const FieldLayout& field, const std::string& key) {
    const MessageLayout* layout = find_message_layout(field.type);
    if (layout == nullptr) return reader_.fail();
    visitor_.begin_struct(key);
    // A walk of its own: lengths and names belong to one struct.
    StructWalk(*layout, reader_, visitor_).walk();
    visitor_.end_struct();
  }

  size_t length_of(const std::string& dimension) {
    int64_t length = -1;
    // A number, or the name of an integer field before it.
    const char* const end = dimension.data() + dimension.size();
    if (std::from_chars(dimension.data(), end, length).ptr != end) {
      const auto place = lengths_.find(dimension);
      length = place != lengths_.end() ? place->second : -1;
    }
    if (length < 0) reader_.fail();
    return length < 0 ? 0 : static_cast<size_t>(length);
  }

  const MessageLayout& layout_;
  WireReader& reader_;
  MessageVisitor& visitor_;
  /** Values of the integer fields read so far, by name: array lengths are among them. */
  std::map<std::string, int64_t> lengths_;
  /** Entries of string arrays, by the dimension that they share with the arrays that they label. */
  std::map<std::string, std::vector<std::string>> names_;
};

}  // namespace

void MessageVisitor::enumerator(const std::string& key, int64_t value,
                                const std::string& /*constant*/) {
  integer(key, value);
}

bool walk_message(const MessageLayout& layout, std::span<const uint8_t> message,
                  MessageVisitor& visitor) {
  WireReader reader(message);
  // The fingerprint is checked by the caller, who chose the layout by it.
  reader.take(kFingerprintSize);
  StructWalk(layout, reader, visitor).walk();
  return reader.is_good() && reader.is_at_end();
}

}  // namespace nao
