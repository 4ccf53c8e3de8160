#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "tools/foxglove/asset_folder.h"
#include "tools/foxglove/server_core.h"

namespace nao {
class AsioLoop;
}

namespace nao::foxglove {

struct NetworkOptions {
  /** Address to listen on. */
  std::string bind = "127.0.0.1";
  /** 0: the system chooses, see Network::port(). Default: as other servers of the protocol. */
  uint16_t port = 8765;
  /** Other names of this host that browsers may use. */
  std::vector<std::string> host_names;
  /** Sites whose pages may connect, such as "https://app.foxglove.dev". */
  std::vector<std::string> origins;
  /** See ConnectionContext. */
  bool accepts_viewers = false;
};

/** Sockets and their loop: WebSockets and, on the same port, the robot's files over HTTP. */
class Network {
 public:
  /** Starts to listen. Core and files must outlive this.
   * @throws Error  naming the port or address that cannot be used. */
  Network(const NetworkOptions& options, ServerCore& core, AssetFolder& files);
  ~Network();
  Network(const Network&) = delete;
  Network& operator=(const Network&) = delete;

  uint16_t port() const;
  /** The loop that the connections run in. */
  AsioLoop& loop();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace nao::foxglove
