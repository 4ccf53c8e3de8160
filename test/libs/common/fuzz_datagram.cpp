// Input of libFuzzer: a datagram that has come to the bus's port.
#include <cstdint>
#include <cstdlib>
#include <string>

#include "common/bus_socket.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const auto message = nao::parse_datagram({data, size});
  if (!message) return 0;
  // Nothing is lost, and the content lies within the datagram.
  if (8 + message->channel.size() + 1 + message->bytes.size() != size) std::abort();
  if (message->channel.find('\0') != std::string::npos) std::abort();
  if (message->bytes.data() + message->bytes.size() != data + size) std::abort();
  return 0;
}
