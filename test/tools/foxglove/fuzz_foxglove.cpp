// Input of libFuzzer: messages of two clients. For each message one byte that selects the client,
// the kind of message and other events, two bytes of length, and the message.
#include <algorithm>
#include <cstdint>
#include <cstdlib>

#include "common/data_path.h"
#include "message_reflection/message_types.h"
#include "tools/foxglove/asset_folder.h"
#include "tools/foxglove/server_core.h"

namespace {

using nao::foxglove::AssetFolder;
using nao::foxglove::ServerCore;

constexpr size_t kMaxQueuedBytes = 1 << 20;

void read_all(ServerCore& core, uint32_t client) {
  size_t num_bytes = 0;
  while (const auto message = core.next_message(client)) num_bytes += message->size();
  if (num_bytes > kMaxQueuedBytes) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  static const std::filesystem::path folder = nao::data_path() / "robots" / "nao";
  static AssetFolder files(folder, folder / "nao.urdf");
  ServerCore core("fuzz", "1", {2, kMaxQueuedBytes},
                  [](std::string_view uri) { return files.read_uri(uri); });
  const auto check = [](const std::string& channel, std::span<const uint8_t> message) {
    const auto* type = nao::find_message_type(message.data(), static_cast<int>(message.size()));
    if (type == nullptr || !type->decodes(message.data(), static_cast<int>(message.size())) ||
        !channel.ends_with("_COMMAND")) {
      std::abort();
    }
  };
  const auto now = [] { return int64_t{1}; };
  const auto robot_now = [] { return int64_t{0}; };
  nao::foxglove::ClientPublisher publisher("fuzz", "NAO", now, robot_now, check);
  core.allow_publishing(publisher);
  for (const char* topic : {"A", "B", "C"}) core.add_channel(topic, "a", "{}");
  uint32_t clients[]{core.open([] {}), core.open([] {})};
  while (size >= 3) {
    const uint8_t events = data[0];
    const size_t length = std::min<size_t>(size_t{data[1]} << 8 | data[2], size - 3);
    const std::string_view message(reinterpret_cast<const char*>(data) + 3, length);
    uint32_t& client = clients[events & 1];
    if ((events & 2) != 0) {
      core.receive_binary(client, message);
    } else {
      core.receive_text(client, message);
    }
    if ((events & 4) != 0) core.publish(1 + (events >> 4) % 3, 1, "content");
    if ((events & 8) != 0) read_all(core, client);
    if (core.must_close(client)) {
      core.close(client);
      client = core.open([] {});
    }
    data += 3 + length;
    size -= 3 + length;
  }
  for (const uint32_t client : clients) {
    read_all(core, client);
    core.close(client);
  }
  for (uint32_t channel = 1; channel <= 3; ++channel) {
    if (core.has_subscribers(channel)) std::abort();
  }
  (void)nao::foxglove::choose_subprotocol({reinterpret_cast<const char*>(data), size});
  return 0;
}
