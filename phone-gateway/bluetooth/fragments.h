#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace nao {

/** Messages over Bluetooth, cut into fragments, which are the values that a phone writes to the
 * characteristic and the gateway notifies.
 *
 * A fragment is a byte and a part of a message. Bit 7 of the byte: the message ends with it. Bits 0
 * to 6: number of the fragment modulo 128, from 0 on in each direction. A byte alone is from a
 * phone an acknowledgement, the number of the fragment that it awaits, after each message and
 * each kAcknowledgedBytes; from the gateway the end of the connection.
 *
 * A phone begins a connection by asking for notifications and then reading the characteristic: two
 * bytes, the longest value in bytes, the least significant byte first. */
inline constexpr uint8_t kLastFragment = 0x80;
inline constexpr size_t kNumFragmentNumbers = 128;
/** Bytes after which a phone acknowledges within a message. */
inline constexpr size_t kAcknowledgedBytes = 500;
/** Value that tells a phone that its connection has ended. */
inline constexpr std::string_view kConnectionEnd("\xff", 1);
/** Longest value, bytes: of an attribute (Bluetooth Core Specification 5.4, Vol 3, Part F, 3.2.9),
 * and without an exchange of the MTU (ibid., 3.2.8: 23, of which three are the header). */
inline constexpr size_t kMaxValueBytes = 512;
inline constexpr size_t kMinValueBytes = 20;

/** Joins the fragments of one direction. */
class FragmentReader {
 public:
  enum class Result { kIncomplete, kMessage, kAcknowledgement, kFault };

  /** @param max_bytes  Of a message; a longer one is a fault. */
  explicit FragmentReader(size_t max_bytes) : max_bytes_(max_bytes) {}

  /** After a fault the connection must end. */
  [[nodiscard]] Result read(std::string_view value);
  /** The message, after kMessage. */
  std::string take_message() { return std::exchange(message_, {}); }
  /** Number of the fragment that the phone awaits, after kAcknowledgement. */
  uint8_t awaited() const { return awaited_; }

 private:
  size_t max_bytes_;
  std::string message_;
  uint8_t next_ = 0;
  uint8_t awaited_ = 0;
  bool is_complete_ = false;
};

/** Cuts messages, and bounds the bytes under way: more would wait in the radio's queue, and a newer
 * state behind them. */
class FragmentWriter {
 public:
  /** @param value_bytes  Longest value, kMinValueBytes to kMaxValueBytes. */
  explicit FragmentWriter(size_t value_bytes) : value_bytes_(value_bytes) {}

  /** Begins a message; only when the one before is sent. */
  void put(std::string message);
  /** The next fragment; nothing: the message is sent, or too much is under way. */
  std::optional<std::string> next();
  bool is_sent() const { return message_.empty(); }
  /** @return false: no such fragment is under way, and the connection must end. */
  [[nodiscard]] bool acknowledge(uint8_t awaited);
  /** Bytes under way. */
  size_t unacknowledged() const { return num_bytes_; }
  /** Fragments made, and acknowledged, until now. */
  uint64_t num_made() const { return num_made_; }
  uint64_t num_acknowledged() const { return num_made_ - sizes_.size(); }

 private:
  size_t value_bytes_;
  std::string message_;
  size_t begin_ = 0;
  uint64_t num_made_ = 0;
  /** Of the fragments under way. */
  std::deque<size_t> sizes_;
  size_t num_bytes_ = 0;
};

}  // namespace nao
