#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "phone-gateway/secure_channel/invitations.h"
#include "phone-gateway/server/network/connection_context.h"

namespace nao::gateway {

/** The valid invitation of an id; nullptr: there is none. */
using FindInvitation = std::function<const Invitation*(std::string_view id)>;

/** A phone that is connected over nao-relay, from the gateway's side. */
class RelayedPhone {
 public:
  virtual ~RelayedPhone() = default;
  /** Closes the connection if its invitation has ended. */
  virtual void check_invitation() = 0;
};

/** Fetches the phone of a ticket from the relay and serves it until it ends. The connection needs
 * no TLS: all that the phone and the gateway exchange is encrypted between them (secure_channel.h).
 * @param host  Of the relay, for the Host header. */
std::weak_ptr<RelayedPhone> serve_relayed_phone(ConnectionContext& context,
                                                const Tcp::endpoint& relay, const std::string& host,
                                                const std::string& ticket,
                                                FindInvitation find_invitation);

}  // namespace nao::gateway
