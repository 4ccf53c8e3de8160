// Input of libFuzzer: a settings file of an exhibition (first byte even), or its state file.
#include <cstdint>
#include <cstdlib>
#include <string>

#include "common/error.h"
#include "phone-gateway/server/exhibition/exhibition_settings.h"
#include "phone-gateway/server/exhibition/fence.h"
#include "phone-gateway/server/exhibition/queue_file.h"

namespace nao::gateway {
namespace {

void require(bool condition) {
  if (!condition) std::abort();
}

void read_settings(const std::string& text) {
  try {
    const ExhibitionSettings settings = parse_exhibition(text, "fair.yaml", {"Vega"});
    require(settings.rules.turn > 0 && settings.rules.warning < settings.rules.turn);
    require(settings.speed > 0 && settings.speed <= 1);
    (void)Fence(settings.fence).limit({0.3, 0.1, 0.2}, {{0.1, 0.2}, 0.3});
  } catch (const ConfigError&) {
  }
}

void read_state(const std::string& text) {
  QueueState state;
  try {
    state = read_queue_state(text);
  } catch (const Error&) {
    return;
  }
  const std::string written = write_queue_state(state);
  require(write_queue_state(read_queue_state(written)) == written);
  VisitorQueue queue({}, {"Vega"}, std::move(state));
  queue.attend("key", false);
  for (int i = 0; i < 100; ++i) queue.step(1);
  (void)queue.view("key");
  (void)write_exhibition_report(queue.state());
}

}  // namespace
}  // namespace nao::gateway

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  if (size == 0) return 0;
  const std::string text(reinterpret_cast<const char*>(data) + 1, size - 1);
  if (data[0] % 2 == 0) {
    nao::gateway::read_settings(text);
  } else {
    nao::gateway::read_state(text);
  }
  return 0;
}
