#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <thread>

#include "tools/bench/wire_client.h"

namespace nao::bench {

/** Three clients that must not affect other clients, in their own thread: one subscribes to every
 * state and image and never reads, one reads 1 kB a second, one sends 10,000 requests a second and
 * reads all answers. */
class DisturbingClients {
 public:
  explicit DisturbingClients(uint16_t tcp_port);
  ~DisturbingClients();
  DisturbingClients(const DisturbingClients&) = delete;
  DisturbingClients& operator=(const DisturbingClients&) = delete;

 private:
  void run();
  void flood();

  std::unique_ptr<WireClient> stalled_;
  std::unique_ptr<WireClient> slow_;
  std::unique_ptr<WireClient> flooding_;
  /** Requests that have not been sent yet. */
  std::string flood_;
  std::atomic<bool> is_ending_ = false;
  std::thread thread_;
};

}  // namespace nao::bench
