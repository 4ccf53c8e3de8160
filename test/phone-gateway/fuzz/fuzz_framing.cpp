// Input of libFuzzer: bytes for the reader of raw TCP messages. The first byte is the size of the
// pieces in which the others are passed, minus one.
#include <cstdint>
#include <cstdlib>
#include <string>

#include "phone-gateway/protocol/framing.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  if (size == 0) return 0;
  const size_t piece = 1 + data[0];
  const std::string_view stream(reinterpret_cast<const char*>(data) + 1, size - 1);
  nao::FrameReader reader(nao::kMaxRequestBytes);
  std::string taken;
  for (size_t start = 0; start < stream.size(); start += piece) {
    reader.add(stream.substr(start, piece));
    while (const auto message = reader.next()) {
      if (message->size() > nao::kMaxRequestBytes) std::abort();
      taken += nao::frame(*message);
    }
  }
  // The messages, framed again, are the beginning of the input.
  if (stream.substr(0, taken.size()) != taken) std::abort();
  if (!reader.is_oversized() && taken.size() + reader.num_waiting_bytes() != stream.size()) {
    std::abort();
  }
  return 0;
}
