#include "protocol/framing.h"

#include <cstdint>

namespace nao {
namespace {

constexpr size_t kLengthBytes = 4;

uint32_t read_length(const char* bytes) {
  uint32_t length = 0;
  for (size_t i = 0; i < kLengthBytes; ++i) {
    length = (length << 8) | static_cast<unsigned char>(bytes[i]);
  }
  return length;
}

}  // namespace

std::string frame(std::string_view message) {
  const auto length = static_cast<uint32_t>(message.size());
  std::string framed;
  framed.reserve(kLengthBytes + message.size());
  for (int shift = 24; shift >= 0; shift -= 8) {
    framed.push_back(static_cast<char>((length >> shift) & 0xff));
  }
  framed.append(message);
  return framed;
}

void FrameReader::add(std::string_view bytes) {
  if (is_oversized_) return;
  // Only what is unread is kept, so that the buffer does not grow with the connection.
  buffer_.erase(0, start_);
  start_ = 0;
  buffer_.append(bytes);
}

std::optional<std::string> FrameReader::next() {
  if (is_oversized_ || num_waiting_bytes() < kLengthBytes) return std::nullopt;
  const size_t length = read_length(buffer_.data() + start_);
  if (length > max_message_bytes_) {
    is_oversized_ = true;
    buffer_.clear();
    start_ = 0;
    return std::nullopt;
  }
  if (num_waiting_bytes() - kLengthBytes < length) return std::nullopt;
  std::string message = buffer_.substr(start_ + kLengthBytes, length);
  start_ += kLengthBytes + length;
  return message;
}

}  // namespace nao
