#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "common/bus.h"
#include "common/child_process.h"
#include "tools/bench/wire_client.h"

namespace nao::bench {

/** First request of a client. */
naoremote::Request connect_request(const std::string& name);

/** Simulator, motion, camera and gateway on their own bus, and their messages. The destructor ends
 * them. */
class GatewayStack {
 public:
  using Handler = std::function<void(const naoremote::ServerMessage&, double)>;

  /** Token of the gateway, which clients on other hosts send. */
  static constexpr const char* kToken = "bench";

  /** Starts the programs and waits until they are ready. @param gateway_options  Of the
   * gateway; none: one on this host, at free ports.
   * @throws std::runtime_error  if they are not ready within a minute. */
  explicit GatewayStack(const std::string& lcm_url,
                        const std::vector<std::string>& gateway_options = {});

  uint16_t http_port() const { return http_port_; }
  uint16_t tcp_port() const { return tcp_port_; }
  const ChildProcess& program(const std::string& name) const { return *programs_.at(name); }
  const ChildProcess& gateway() const { return program("nao-phone-gateway"); }
  Bus& bus() { return bus_; }

  /** Has a function called with every message that comes to a client and its time of arrival, s,
   * inside run_until() and run_for(). */
  void watch(WireClient* client, Handler handler);
  void forget_clients() { clients_.clear(); }

  /** Handles messages until a condition holds. @throws std::runtime_error  after a minute, with
   * `what` as the awaited condition. */
  void run_until(const std::function<bool()>& is_done, const std::string& what);
  /** Handles messages for a time, s. */
  void run_for(double time);

  /** Target and measured angle of the head's yaw, rad, and when each was received, s. */
  double yaw_target = 0;
  double yaw = 0;
  double yaw_target_time = 0;
  double yaw_time = 0;
  /** When the measured angle last changed, s. */
  double yaw_still_since = 0;

  /** When the state of a robot time was on the bus, s; none if it was not received. */
  std::optional<double> time_of_state(uint64_t utime) const;

 private:
  struct Watched {
    WireClient* client;
    Handler handler;
  };

  void subscribe();
  void pump(double timeout);

  Bus bus_;
  std::map<std::string, std::unique_ptr<ChildProcess>> programs_;
  std::set<std::string> ready_;
  uint16_t http_port_ = 0;
  uint16_t tcp_port_ = 0;
  std::vector<Watched> clients_;
  std::map<int64_t, double> state_times_;
};

}  // namespace nao::bench
