#include "phone-gateway/secure_channel/relay_target.h"

#include <openssl/evp.h>

#include <array>

#include "common/error.h"
#include "phone-gateway/secure_channel/hexadecimal.h"

namespace nao {
namespace {

struct Form {
  RelayTarget::Kind kind;
  std::string_view start;
  size_t num_bytes;
};
constexpr std::array<Form, 3> kForms{{{RelayTarget::Kind::kPhone, "/ws?robot=", kRobotIdBytes},
                                      {RelayTarget::Kind::kRobot, "/ws?key=", kRobotKeyBytes},
                                      {RelayTarget::Kind::kTicket, "/ws?ticket=", kTicketBytes}}};

}  // namespace

std::optional<RelayTarget> parse_relay_target(std::string_view target) {
  for (const Form& form : kForms) {
    if (!target.starts_with(form.start)) continue;
    const std::string_view value = target.substr(form.start.size());
    if (!from_hex(value, form.num_bytes)) return std::nullopt;
    return RelayTarget{form.kind, std::string(value)};
  }
  return std::nullopt;
}

std::string write_relay_target(const RelayTarget& target) {
  for (const Form& form : kForms) {
    if (form.kind == target.kind) return std::string(form.start) + target.value;
  }
  return "";
}

std::string robot_of_key(const std::string& key) {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  if (EVP_Digest(key.data(), key.size(), digest.data(), nullptr, EVP_sha256(), nullptr) != 1) {
    throw Error("OpenSSL fails: SHA-256");
  }
  return to_hex({reinterpret_cast<const char*>(digest.data()), kRobotIdBytes});
}

}  // namespace nao
