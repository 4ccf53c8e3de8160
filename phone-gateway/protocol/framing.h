#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace nao {

/** Largest Request that the gateway accepts on any transport, bytes; see PROTOCOL.md. */
inline constexpr size_t kMaxRequestBytes = 262144;

/** Version of the protocol in remote.proto, sent in Connect. */
inline constexpr unsigned kProtocolVersion = 1;

inline constexpr size_t kFrameLengthBytes = 4;

/** Header of a message of `size` bytes over raw TCP: that size, most significant byte first. */
std::array<char, kFrameLengthBytes> frame_length(size_t size);

/** A message as it is sent over raw TCP: its length in 4 bytes, most significant first, then the
 * message. */
std::string frame(std::string_view message);

/** Splits the bytes of a raw TCP connection into messages. */
class FrameReader {
 public:
  /** @param max_message_bytes  After a longer message nothing can be read any more. */
  explicit FrameReader(size_t max_message_bytes) : max_message_bytes_(max_message_bytes) {}

  /** Appends received bytes, in pieces of any size. */
  void add(std::string_view bytes);

  /** @return The next message; nothing if it is incomplete or too long. */
  [[nodiscard]] std::optional<std::string> next();

  /** True once a length above the limit has been received. */
  bool is_oversized() const { return is_oversized_; }

  /** Received bytes of an incomplete message. */
  size_t num_waiting_bytes() const { return buffer_.size() - start_; }

 private:
  size_t max_message_bytes_;
  std::string buffer_;
  size_t start_ = 0;
  bool is_oversized_ = false;
};

}  // namespace nao
