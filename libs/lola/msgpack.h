#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace nao {

/** Reads the values of a MessagePack text one after the other, without allocating.
 *
 * Own code, since Debian's msgpack-cxx 4.1.3 writes whole floats as integers, which LoLA's clients
 * do not accept, and its readers allocate for every message. Source: MessagePack specification,
 * github.com/msgpack/msgpack, spec.md. */
class MsgpackReader {
 public:
  enum class Kind { kNil, kBool, kNumber, kText, kBinary, kArray, kMap, kIncomplete, kMalformed };

  /** A value, or the head of an array or map. */
  struct Token {
    Kind kind = Kind::kIncomplete;
    /** Value of a number; 0 or 1 for a bool. */
    double number = 0;
    /** Bytes of a text or binary; points into the input. */
    std::string_view text;
    /** Elements of an array, pairs of a map. */
    uint32_t size = 0;
  };

  explicit MsgpackReader(std::span<const uint8_t> bytes) : bytes_(bytes) {}

  /** Reads the next value. After kIncomplete and kMalformed nothing more can be read. */
  Token next();
  /** Reads the next value with all that it contains. @return kIncomplete, kMalformed, or its kind.
   */
  Kind skip();
  /** Bytes read. */
  size_t position() const { return position_; }

 private:
  /** @return Unsigned integer of so many bytes, most significant first; moves on.
   * @param is_there  Set to false if the input ends before. */
  uint64_t read(size_t num_bytes, bool& is_there);
  Token number(uint64_t value, bool is_there) const;
  Token signed_number(size_t num_bytes);
  Token floating(size_t num_bytes);
  Token text(Kind kind, uint64_t size, bool is_there);
  Token head(Kind kind, uint64_t size, bool is_there) const;

  std::span<const uint8_t> bytes_;
  size_t position_ = 0;
};

/** Writes MessagePack into memory of the caller, without allocating. Lengths are at most 65535. */
class MsgpackWriter {
 public:
  explicit MsgpackWriter(std::span<uint8_t> memory) : memory_(memory) {}

  void map(size_t num_pairs);
  void array(size_t num_elements);
  /** Always as float32, whole numbers too. */
  void number(float value);
  /** 0 to 127. */
  void small_integer(int value);
  void boolean(bool value);
  void text(std::string_view value);

  /** Bytes written; 0 if the memory was too small. */
  size_t size() const { return is_full_ ? 0 : size_; }

 private:
  void byte(uint64_t value);
  void bytes(uint64_t value, size_t num_bytes);

  std::span<uint8_t> memory_;
  size_t size_ = 0;
  bool is_full_ = false;
};

}  // namespace nao
