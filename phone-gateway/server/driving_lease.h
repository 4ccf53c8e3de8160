#pragma once

#include <cstdint>

namespace nao {

/** Number of the operator's console in place of a client's. */
inline constexpr uint32_t kOperatorId = 4294967295u;

/** Who drives. One client at most; whoever asks first, until it gives back, goes away, or gave no
 * command for a while and somebody else asks. The operator overrides everybody. */
class DrivingLease {
 public:
  /** @param idle_time  s without a command after which somebody else may take over. */
  explicit DrivingLease(double idle_time) : idle_time_(idle_time) {}

  /** Client that drives; 0 if nobody does. */
  uint32_t driver() const { return driver_; }

  /** @return true if `client` drives from now on. */
  bool take(uint32_t client, double now) {
    const bool is_free = driver_ == 0 || driver_ == client;
    const bool is_abandoned = driver_ != kOperatorId && now - last_command_ > idle_time_;
    if (!is_free && !is_abandoned && client != kOperatorId) return false;
    driver_ = client;
    last_command_ = now;
    return true;
  }

  /** The driver gave a command. */
  void refresh(double now) { last_command_ = now; }

  /** @return true if `client` was the driver; nobody drives then. */
  bool release(uint32_t client) {
    if (driver_ != client || client == 0) return false;
    driver_ = 0;
    return true;
  }

 private:
  double idle_time_;
  uint32_t driver_ = 0;
  double last_command_ = 0;
};

}  // namespace nao
