#pragma once

#include <cstdint>

namespace nao::gateway {

/** Driver id of the operator's console; clients count from 1. */
inline constexpr uint32_t kOperatorId = 4294967295u;

/** The control lease: at most one client drives. The first client that asks gets it, and keeps it
 * until it releases it, disconnects, or sends no command for a while and another client asks. The
 * operator overrides every client. */
class DrivingLease {
 public:
  /** @param idle_timeout  s without a command after which another client may take over. */
  explicit DrivingLease(double idle_timeout) : idle_timeout_(idle_timeout) {}

  /** Client that drives; 0 if none. */
  uint32_t driver() const { return driver_; }

  /** Whether `client` would get the lease. */
  bool can_take(uint32_t client, double now) const {
    const bool is_free = driver_ == 0 || driver_ == client;
    const bool is_idle = driver_ != kOperatorId && now - last_command_ > idle_timeout_;
    return is_free || is_idle || client == kOperatorId;
  }

  /** @return true if `client` drives from now on. */
  bool take(uint32_t client, double now) {
    if (!can_take(client, now)) return false;
    assign(client, now);
    return true;
  }

  /** Gives the lease to a client, also if another one has it. */
  void assign(uint32_t client, double now) {
    driver_ = client;
    last_command_ = now;
  }

  /** The driver sent a command. */
  void refresh(double now) { last_command_ = now; }

  /** @return true if `client` was the driver; the lease is free then. */
  bool release(uint32_t client) {
    if (driver_ != client || client == 0) return false;
    driver_ = 0;
    return true;
  }

 private:
  double idle_timeout_;
  uint32_t driver_ = 0;
  double last_command_ = 0;
};

}  // namespace nao::gateway
