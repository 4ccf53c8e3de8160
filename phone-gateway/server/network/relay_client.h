#pragma once

#include <memory>
#include <string>

#include "phone-gateway/server/network/connection_context.h"

namespace nao::gateway {

/** Keeps the gateway connected with nao-relay: dials again with growing pauses, up to 2 s, and
 * serves the phones that the relay announces. Without the relay, all else goes on.
 *
 * The relay's certificate is not checked: a program in its place can read and change nothing
 * between phones and gateway (secure_channel.h). */
class RelayClient {
 public:
  /** @param address  HOST[:PORT]. @param file  Of invitations, read again when it has changed.
   * @throws ConfigError  The address or the file is wrong. */
  RelayClient(ConnectionContext& context, const std::string& address, const std::string& file);
  ~RelayClient();

  /** Invitations that have ended end their connections. Call it a few times a second. */
  void step();

 private:
  struct Impl;
  std::shared_ptr<Impl> impl_;
};

}  // namespace nao::gateway
