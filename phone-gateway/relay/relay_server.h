#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "phone-gateway/relay/relay_core.h"

namespace nao {
class AsioLoop;
}

namespace nao::relay {

/** Addresses, certificate and limits of a relay. */
struct RelayOptions {
  /** "0.0.0.0": all, of IPv4 and IPv6. */
  std::string bind = "0.0.0.0";
  /** 0: the system chooses. */
  uint16_t port = 8443;
  /** PEM. */
  std::string certificate_file;
  std::string key_file;
  RelayLimits limits;
};

/** The relay's socket: the app's files, and phones connected with the gateways of their robots. It
 * passes bytes on, and keeps at most 2 kB of them in each direction: who does not read stops the
 * other end. */
class RelayServer {
 public:
  /** Starts to listen. @throws Error  naming the port or file that cannot be used. */
  explicit RelayServer(const RelayOptions& options);
  ~RelayServer();
  RelayServer(const RelayServer&) = delete;
  RelayServer& operator=(const RelayServer&) = delete;

  uint16_t port() const;
  /** The loop that the connections run in. */
  AsioLoop& loop();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace nao::relay
