#include "lola/msgpack.h"

#include <bit>

namespace nao {

// Big-endian number of some bytes. `is_there` becomes false, and stays so, when the input ends.
uint64_t MsgpackReader::read(size_t num_bytes, bool& is_there) {
  is_there = is_there && bytes_.size() - position_ >= num_bytes;
  if (!is_there) return 0;
  uint64_t value = 0;
  for (size_t i = 0; i < num_bytes; ++i) value = value << 8 | bytes_[position_++];
  return value;
}

MsgpackReader::Token MsgpackReader::number(uint64_t value, bool is_there) const {
  if (!is_there) return {};
  return {Kind::kNumber, static_cast<double>(value), {}, 0};
}

MsgpackReader::Token MsgpackReader::signed_number(size_t num_bytes) {
  bool is_there = true;
  const uint64_t value = read(num_bytes, is_there);
  if (!is_there) return {};
  // Moves the sign bit to the highest place and back.
  const auto shift = static_cast<int>(64 - 8 * num_bytes);
  return {Kind::kNumber, static_cast<double>(static_cast<int64_t>(value << shift) >> shift), {}, 0};
}

MsgpackReader::Token MsgpackReader::floating(size_t num_bytes) {
  bool is_there = true;
  const uint64_t value = read(num_bytes, is_there);
  if (!is_there) return {};
  const double number =
      num_bytes == 4 ? static_cast<double>(std::bit_cast<float>(static_cast<uint32_t>(value)))
                     : std::bit_cast<double>(value);
  return {Kind::kNumber, number, {}, 0};
}

MsgpackReader::Token MsgpackReader::text(Kind kind, uint64_t size, bool is_there) {
  // The length comes from outside: compared with what is left before any use.
  if (!is_there || bytes_.size() - position_ < size) return {};
  const auto* begin = reinterpret_cast<const char*>(bytes_.data() + position_);
  position_ += size;
  return {kind, 0, {begin, size}, 0};
}

MsgpackReader::Token MsgpackReader::head(Kind kind, uint64_t size, bool is_there) const {
  if (!is_there) return {};
  return {kind, 0, {}, static_cast<uint32_t>(size)};
}

MsgpackReader::Token MsgpackReader::next() {
  bool is_there = true;
  const uint64_t first = read(1, is_there);
  if (!is_there) return {};
  // First bytes of the MessagePack specification: positive fixint, fixmap, fixarray, fixstr and
  // negative fixint carry their value or length themselves.
  if (first <= 0x7f) return number(first, true);
  if (first <= 0x8f) return head(Kind::kMap, first & 0x0f, true);
  if (first <= 0x9f) return head(Kind::kArray, first & 0x0f, true);
  if (first <= 0xbf) return text(Kind::kText, first & 0x1f, true);
  if (first >= 0xe0) return {Kind::kNumber, static_cast<double>(first) - 256, {}, 0};
  // Lengths are read first, since the order in which arguments are evaluated is not defined.
  const auto length = [&](size_t num_bytes) { return read(num_bytes, is_there); };
  switch (first) {
    case 0xc0:
      return {Kind::kNil, 0, {}, 0};
    case 0xc2:
    case 0xc3:
      return {Kind::kBool, static_cast<double>(first & 1), {}, 0};
    // bin 8, 16, 32.
    case 0xc4:
    case 0xc5:
    case 0xc6: {
      const uint64_t size = length(size_t{1} << (first - 0xc4));
      return text(Kind::kBinary, size, is_there);
    }
    case 0xca:
      return floating(4);
    case 0xcb:
      return floating(8);
    // uint 8 to 64; a value that a double does not hold exactly is rounded.
    case 0xcc:
    case 0xcd:
    case 0xce:
    case 0xcf: {
      const uint64_t value = length(size_t{1} << (first - 0xcc));
      return number(value, is_there);
    }
    case 0xd0:
    case 0xd1:
    case 0xd2:
    case 0xd3:
      return signed_number(size_t{1} << (first - 0xd0));
    // str 8, 16, 32.
    case 0xd9:
    case 0xda:
    case 0xdb: {
      const uint64_t size = length(size_t{1} << (first - 0xd9));
      return text(Kind::kText, size, is_there);
    }
    // array 16, 32.
    case 0xdc:
    case 0xdd: {
      const uint64_t size = length(size_t{2} << (first - 0xdc));
      return head(Kind::kArray, size, is_there);
    }
    // map 16, 32.
    case 0xde:
    case 0xdf: {
      const uint64_t size = length(size_t{2} << (first - 0xde));
      return head(Kind::kMap, size, is_there);
    }
    default:
      // Never used (0xc1), or an extension type, of which LoLA has none.
      return {Kind::kMalformed, 0, {}, 0};
  }
}

// Without recursion: the depth of nesting comes from outside and must not use the stack.
MsgpackReader::Kind MsgpackReader::skip() {
  const Token first = next();
  // Values that are still to come. Each takes one byte at least, so a count that the input cannot
  // hold ends in kIncomplete; the sum cannot overflow before.
  uint64_t num_left = 0;
  const auto count = [&](const Token& token) {
    if (token.kind == Kind::kArray) num_left += token.size;
    if (token.kind == Kind::kMap) num_left += 2ull * token.size;
  };
  count(first);
  for (; num_left > 0; --num_left) {
    const Token token = next();
    if (token.kind == Kind::kIncomplete || token.kind == Kind::kMalformed) return token.kind;
    count(token);
  }
  return first.kind;
}

// is_full_ marks a message that does not fit; nothing is written beyond the memory.
void MsgpackWriter::byte(uint64_t value) {
  if (size_ == memory_.size()) {
    is_full_ = true;
    return;
  }
  memory_[size_++] = static_cast<uint8_t>(value);
}

void MsgpackWriter::bytes(uint64_t value, size_t num_bytes) {
  for (size_t i = num_bytes; i > 0; --i) byte(value >> (8 * (i - 1)) & 0xff);
}

void MsgpackWriter::map(size_t num_pairs) {
  if (num_pairs < 16) {
    byte(0x80 | num_pairs);
  } else {
    byte(0xde);
    bytes(num_pairs, 2);
  }
}

void MsgpackWriter::array(size_t num_elements) {
  if (num_elements < 16) {
    byte(0x90 | num_elements);
  } else {
    byte(0xdc);
    bytes(num_elements, 2);
  }
}

// float 32, as in LoLA's own messages.
void MsgpackWriter::number(float value) {
  byte(0xca);
  bytes(std::bit_cast<uint32_t>(value), 4);
}

void MsgpackWriter::small_integer(int value) {
  byte(static_cast<uint64_t>(value) & 0x7f);
}

void MsgpackWriter::boolean(bool value) {
  byte(value ? 0xc3 : 0xc2);
}

void MsgpackWriter::text(std::string_view value) {
  if (value.size() < 32) {
    byte(0xa0 | value.size());
  } else {
    byte(0xda);
    bytes(value.size(), 2);
  }
  for (const char letter : value) byte(static_cast<uint8_t>(letter));
}

}  // namespace nao
