#include "phone-gateway/server/core/admission.h"

#include "phone-gateway/protocol/framing.h"

namespace nao::gateway {
namespace {

/** Addresses whose wrong tokens are counted. Chosen: bounds memory against a host that uses many
 * IPv6 addresses; a classroom has fewer. */
constexpr size_t kMaxCountedAddresses = 256;

Refusal refuse(naoremote::ErrorCode error, GatewayReasonCode code,
               std::vector<std::string> arguments = {}) {
  return {error, gateway_reason(code, std::move(arguments))};
}

}  // namespace

bool Admission::is_right_token(const Endpoint& endpoint, const std::string& token) const {
  // Programs on the gateway's own host need no token.
  if (endpoint.is_local && token.empty()) return true;
  if (endpoint.is_invited) return true;
  return !token_.empty() && equals_secret(plain_token(token), token_);
}

// Order: version, pause after wrong tokens, token, and the limits of clients; the first fault is
// the answer.
std::optional<Refusal> Admission::check(const Endpoint& endpoint, const naoremote::Connect& request,
                                        const Sessions& sessions, double now) {
  if (request.protocol_version() != kProtocolVersion) {
    return refuse(naoremote::WRONG_VERSION, "protocol-version-unsupported",
                  {std::to_string(request.protocol_version()), std::to_string(kProtocolVersion)});
  }
  // During the pause the right token is refused, too: otherwise guessing could go on.
  const auto known = wrong_tokens_.find(endpoint.address);
  if (known != wrong_tokens_.end() && known->second.count >= limits_.max_wrong_tokens &&
      now - known->second.last < limits_.wrong_token_pause) {
    return refuse(naoremote::WRONG_TOKEN, "too-many-wrong-tokens",
                  {to_argument(limits_.wrong_token_pause)});
  }
  if (!is_right_token(endpoint, request.token())) {
    // All counts are dropped rather than memory grows: an attacker with many addresses gains a few
    // more guesses (make_token).
    if (wrong_tokens_.size() >= kMaxCountedAddresses) wrong_tokens_.clear();
    WrongTokens& wrong = wrong_tokens_[endpoint.address];
    // After the pause the count begins again.
    if (wrong.count >= limits_.max_wrong_tokens) wrong.count = 0;
    ++wrong.count;
    wrong.last = now;
    return refuse(naoremote::WRONG_TOKEN, "token-wrong");
  }
  wrong_tokens_.erase(endpoint.address);
  if (sessions.num_connected() >= limits_.max_clients) {
    return refuse(naoremote::TOO_MANY_CLIENTS, "too-many-clients",
                  {std::to_string(limits_.max_clients)});
  }
  // One address must not take all places; the own host may.
  if (!endpoint.is_local &&
      sessions.num_connected_from(endpoint.address) >= limits_.max_clients_per_address) {
    return refuse(naoremote::TOO_MANY_CLIENTS, "too-many-clients-of-address",
                  {std::to_string(limits_.max_clients_per_address)});
  }
  return std::nullopt;
}

}  // namespace nao::gateway
