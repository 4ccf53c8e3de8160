// Input of libFuzzer: by the first byte a target of nao-relay, its address, a file of invitations,
// or what a phone sends to the gateway over it.
#include <cstdint>
#include <cstdlib>
#include <string>

#include "common/error.h"
#include "phone-gateway/secure_channel/invitations.h"
#include "phone-gateway/secure_channel/relay_target.h"
#include "phone-gateway/secure_channel/secure_channel.h"

namespace nao {
namespace {

void require(bool condition) {
  if (!condition) std::abort();
}

void read_target(const std::string& text) {
  if (const auto target = parse_relay_target(text)) require(write_relay_target(*target) == text);
}

void read_access(const std::string& text) {
  try {
    const RelayAccess access = parse_relay_access(text, "file");
    const std::string written = write_relay_access(access);
    require(write_relay_access(parse_relay_access(written, "file")) == written);
    for (const Invitation& invitation : access.invitations) {
      if (!access.relay.empty()) require(invitation_link(access, invitation).size() > 80);
    }
  } catch (const ConfigError&) {
  }
}

void read_address(const std::string& text) {
  try {
    require(!parse_relay_address(text).host.empty());
  } catch (const ConfigError&) {
  }
}

/** The hello, then one frame, which cannot be good without the secret. */
void read_phone(const std::string& text) {
  static const EphemeralKey key;
  static const std::string secret(kInvitationSecretBytes, 's');
  (void)answer_hello(key, text, secret);
  static const std::string public_key = key.public_key();
  static SecureChannel channel(SecureChannel::Side::kGateway, std::string(32, 'x'), secret, "hello",
                               public_key);
  const OpenedFrame opened = channel.open(text);
  require(opened.fault != FrameFault::kNone && opened.text.empty());
}

}  // namespace
}  // namespace nao

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  if (size == 0) return 0;
  const std::string text(reinterpret_cast<const char*>(data) + 1, size - 1);
  switch (data[0] % 4) {
    case 0:
      nao::read_target(text);
      break;
    case 1:
      nao::read_access(text);
      break;
    case 2:
      nao::read_address(text);
      break;
    default:
      nao::read_phone(text);
  }
  return 0;
}
