// Input of libFuzzer: bytes from a LoLA socket. The first byte is the size of the pieces in which
// the others arrive, minus one.
#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <span>

#include "lola/codec.h"

namespace {

/** Reads a stream in pieces. What was read, written again, must be readable. */
template <class Message>
void read_stream(std::span<const uint8_t> bytes, size_t piece) {
  nao::LolaStream<Message> stream;
  Message message;
  while (!bytes.empty() && stream.error().empty()) {
    const std::span<uint8_t> memory = stream.free_memory();
    if (memory.empty()) std::abort();
    const size_t size = std::min({piece, bytes.size(), memory.size()});
    std::copy_n(bytes.begin(), size, memory.begin());
    stream.note_received(size);
    bytes = bytes.subspan(size);
    while (stream.next(message)) {
      std::array<uint8_t, 8192> written;
      const size_t num_bytes = nao::encode(message, written);
      Message again;
      if (num_bytes > 0 &&
          nao::decode(std::span<const uint8_t>(written.data(), num_bytes), again).status !=
              nao::LolaDecoding::Status::kDone) {
        std::abort();
      }
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  if (size == 0) return 0;
  const size_t piece = size_t{1} + data[0];
  read_stream<nao::LolaState>({data + 1, size - 1}, piece);
  read_stream<nao::LolaCommand>({data + 1, size - 1}, piece);
  return 0;
}
