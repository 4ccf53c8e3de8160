#pragma once

#include <optional>
#include <string>

#include "phone-gateway/server/core/gateway_reasons.h"
#include "phone-gateway/server/core/robots.h"
#include "phone-gateway/server/core/sessions.h"

namespace nao::gateway {

/** Executes the operator's requests (Operate in remote.proto). */
class OperatorConsole {
 public:
  /** Both must outlive this. */
  OperatorConsole(Sessions& sessions, Robots& robots) : sessions_(sessions), robots_(robots) {}

  /** @param console  Session that sent the request; need not be connected.
   * @return Why the request is refused, or nothing. */
  [[nodiscard]] std::optional<Refusal> execute(const ClientSession& console,
                                               const naoremote::Operate& request,
                                               naoremote::Response& response, double now);

 private:
  void list_clients(naoremote::Clients& clients) const;
  /** Takes (true) or releases control of one robot, or of all. */
  std::optional<Refusal> take(const ClientSession& console, const std::string& robot, bool takes,
                              double now);
  std::optional<Refusal> assign(ClientSession& client, const std::string& robot, double now);
  void mute(ClientSession& client, bool is_muted, double now);

  Sessions& sessions_;
  Robots& robots_;
};

}  // namespace nao::gateway
