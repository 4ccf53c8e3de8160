#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace nao {

/** Greatest Request that the gateway takes, bytes, on every transport. */
inline constexpr size_t kMaxRequestBytes = 65536;

/** Version of the protocol in remote.proto, sent in Connect. */
inline constexpr unsigned kProtocolVersion = 1;

inline constexpr size_t kFrameLengthBytes = 4;

/** What goes before a message of `size` bytes over raw TCP: that size, most significant byte first.
 */
std::array<char, kFrameLengthBytes> frame_length(size_t size);

/** A message as it travels over raw TCP: its length in 4 bytes, most significant first, then
 * itself. */
std::string frame(std::string_view message);

/** Cuts the bytes of a raw TCP connection into messages again. */
class FrameReader {
 public:
  /** @param max_message_bytes  A longer message makes the connection unusable. */
  explicit FrameReader(size_t max_message_bytes) : max_message_bytes_(max_message_bytes) {}

  /** Takes the bytes that came, in order, however they were cut. */
  void add(std::string_view bytes);

  /** @return The next whole message, or nothing if it has not arrived whole or is too long. */
  [[nodiscard]] std::optional<std::string> next();

  /** True once a length over the limit has come: nothing after it can be read. */
  bool is_oversized() const { return is_oversized_; }

  /** Bytes that wait for the rest of their message. */
  size_t num_waiting_bytes() const { return buffer_.size() - start_; }

 private:
  size_t max_message_bytes_;
  std::string buffer_;
  size_t start_ = 0;
  bool is_oversized_ = false;
};

}  // namespace nao
