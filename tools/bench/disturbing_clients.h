#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <thread>

#include "tools/bench/wire_client.h"

namespace nao {

/** Three misbehaving clients, in a thread of their own, that must not affect the others: one
 * requests every state and image and never reads, one reads 1 kB/s, one sends 10,000 requests/s and
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
  /** Unsent request bytes. */
  std::string flood_;
  std::atomic<bool> is_ending_ = false;
  std::thread thread_;
};

}  // namespace nao
