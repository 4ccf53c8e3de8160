// Input of libFuzzer: values that a phone writes by Bluetooth, each after a byte with its length;
// the gateway writes messages meanwhile.
#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "phone-gateway/bluetooth/fragments.h"

namespace nao {
namespace {

constexpr size_t kMaxMessage = 4096;

void require(bool condition) {
  if (!condition) std::abort();
}

/** @return false: the connection ends. */
bool write_value(FragmentReader& reader, FragmentWriter& writer, const std::string& value) {
  switch (reader.read(value)) {
    case FragmentReader::Result::kIncomplete:
      return true;
    case FragmentReader::Result::kMessage: {
      const std::string message = reader.take_message();
      require(!message.empty() && message.size() <= kMaxMessage);
      if (writer.is_sent()) writer.put(message);
      return true;
    }
    case FragmentReader::Result::kAcknowledgement:
      return writer.acknowledge(reader.awaited());
    default:
      return false;
  }
}

}  // namespace
}  // namespace nao

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  if (size == 0) return 0;
  nao::FragmentReader reader(nao::kMaxMessage);
  nao::FragmentWriter writer(nao::kMinValueBytes + data[0]);
  // What the gateway sends is read again.
  nao::FragmentReader phone(nao::kMaxMessage);
  size_t at = 1;
  while (at < size) {
    const size_t told = data[at++];
    const size_t length = std::min(told, size - at);
    const std::string value(reinterpret_cast<const char*>(data) + at, length);
    at += length;
    if (!nao::write_value(reader, writer, value)) return 0;
    while (const auto fragment = writer.next()) {
      nao::require(fragment->size() <= nao::kMinValueBytes + data[0]);
      nao::require(phone.read(*fragment) != nao::FragmentReader::Result::kFault);
    }
    nao::require(writer.unacknowledged() < 2500);
  }
  return 0;
}
