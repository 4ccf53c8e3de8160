#pragma once

#include <map>
#include <optional>
#include <string>

#include "phone-gateway/server/core/gateway_limits.h"
#include "phone-gateway/server/core/gateway_reasons.h"
#include "phone-gateway/server/core/secret.h"
#include "phone-gateway/server/core/sessions.h"

namespace nao::gateway {

/** Decides which clients may connect: protocol version, pairing token, number of clients. Addresses
 * that send wrong tokens are refused for a while, so that a token cannot be guessed. */
class Admission {
 public:
  /** @param token  Pairing token that clients of other hosts must send, in whatever case, with or
   *   without hyphens and spaces; clients of this host may leave it out. If it is empty, clients of
   *   other hosts are refused. */
  Admission(const GatewayLimits& limits, const std::string& token)
      : limits_(limits), token_(plain_token(token)) {}

  /** @return Nothing if the client may connect. */
  [[nodiscard]] std::optional<Refusal> check(const Endpoint& endpoint,
                                             const naoremote::Connect& request,
                                             const Sessions& sessions, double now);

 private:
  bool is_right_token(const Endpoint& endpoint, const std::string& token) const;

  /** Wrong tokens of one address since its last right one, and when the last one came, s. */
  struct WrongTokens {
    int count = 0;
    double last = 0;
  };

  GatewayLimits limits_;
  std::string token_;
  std::map<std::string, WrongTokens> wrong_tokens_;
};

}  // namespace nao::gateway
