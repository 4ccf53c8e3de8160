#include "phone-gateway/protocol/framing.h"

#include <cstdint>

namespace nao {
namespace {

uint32_t read_length(const char* bytes) {
  uint32_t length = 0;
  for (size_t i = 0; i < kFrameLengthBytes; ++i) {
    length = (length << 8) | static_cast<unsigned char>(bytes[i]);
  }
  return length;
}

}  // namespace

std::array<char, kFrameLengthBytes> frame_length(size_t size) {
  const auto byte = [size](int shift) { return static_cast<char>((size >> shift) & 0xff); };
  return {byte(24), byte(16), byte(8), byte(0)};
}

std::string frame(std::string_view message) {
  const auto length = frame_length(message.size());
  std::string framed;
  framed.reserve(length.size() + message.size());
  framed.append(length.data(), length.size());
  framed.append(message);
  return framed;
}

void FrameReader::add(std::string_view bytes) {
  if (is_oversized_) return;
  // Consumed bytes are dropped here, once for many messages.
  buffer_.erase(0, start_);
  start_ = 0;
  buffer_.append(bytes);
}

std::optional<std::string> FrameReader::next() {
  if (is_oversized_ || num_waiting_bytes() < kFrameLengthBytes) return std::nullopt;
  const size_t length = read_length(buffer_.data() + start_);
  if (length > max_message_bytes_) {
    is_oversized_ = true;
    buffer_.clear();
    start_ = 0;
    return std::nullopt;
  }
  if (num_waiting_bytes() - kFrameLengthBytes < length) return std::nullopt;
  std::string message = buffer_.substr(start_ + kFrameLengthBytes, length);
  start_ += kFrameLengthBytes + length;
  return message;
}

}  // namespace nao
