#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "phone-gateway/server/core/driving_lease.h"
#include "phone-gateway/server/core/gateway_reasons.h"
#include "phone-gateway/server/core/robot_sessions.h"

namespace nao::gateway {

/** Who has control of one robot: the lease, the notices of its changes, and why it is refused. */
class ControlState {
 public:
  /** `sessions` must outlive this. @param idle_timeout  As of DrivingLease. */
  ControlState(const RobotSessions& sessions, double idle_timeout)
      : sessions_(sessions), lease_(idle_timeout) {}

  /** Client that drives; 0 if none. */
  uint32_t driver() const { return lease_.driver(); }
  /** Its name; empty if none. */
  std::string driver_name() const;
  /** Who has control, as one client sees it. */
  naoremote::Control describe(const ClientSession& session) const;

  /** Whether a client would be granted control. @return Why not, or nothing. */
  [[nodiscard]] std::optional<Refusal> check_taking(const ClientSession& session, double now) const;
  /** Whether a client has control. @return Why it must not command, or nothing. */
  [[nodiscard]] std::optional<Refusal> check(const ClientSession& session) const;

  /** Client that asked the driver for control and waits; nullptr if none. */
  const ClientSession* next() const { return next_ == 0 ? nullptr : sessions_.find(next_); }
  /** A client that was refused waits, unless another one waits. @return true if that is new. */
  bool wait(const ClientSession& session);
  /** @return true if `client` waited; no client waits then. */
  bool withdraw(uint32_t client);

  /** Gives control to a client or the operator, also if another one has it. No client waits then.
   */
  void assign(uint32_t client, double now) {
    lease_.assign(client, now);
    next_ = 0;
  }
  /** @return true if `client` had control; no client waits then. */
  bool release(uint32_t client);
  /** The driver sent a command. */
  void refresh(double now) { lease_.refresh(now); }

  /** Tells the driver why its walk has ended. */
  void tell_driver(const Reason& reason) const;
  /** Tells one client of the robot, or all of them, who has control. */
  void tell(ClientSession& session, const Reason& reason) const;
  void tell_all(const Reason& reason) const;

  /** Writes to the audit log, with the robot's name if there are several. */
  void audit(const std::string& event, const ClientSession& session,
             const std::string& detail) const;

 private:
  Refusal refuse() const;

  const RobotSessions& sessions_;
  DrivingLease lease_;
  uint32_t next_ = 0;
};

}  // namespace nao::gateway
