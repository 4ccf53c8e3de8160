#pragma once

#include <string>
#include <utility>
#include <vector>

#include "common/bus.h"

namespace nao {

/** Publishes a program's daemon_status_t, and tells systemd that it lives: call tick() at every
 * turn of the main loop's own rhythm and publish() once a second. */
class StatusReporter {
 public:
  /** @param program  Name as in daemon_status_t, "nao-sim". The bus must outlive this. */
  StatusReporter(Bus& bus, std::string program);

  /** One turn of the main loop took place at `now`, s of the monotonic clock. */
  void tick(double now);

  /** What the program is doing: "starting", "ready", "waiting" or "stopping", and why in words. */
  void set_state(const std::string& state, const std::string& detail = "");

  /** Sends the status of the time since the last call.
   * @param metrics  The program's own figures, names with units. */
  void publish(const std::vector<std::pair<std::string, double>>& metrics = {});

 private:
  Bus& bus_;
  std::string program_;
  std::string host_;
  std::string state_ = "starting";
  std::string detail_;
  double last_tick_ = 0;
  double period_sum_ = 0;
  double period_worst_ = 0;
  int num_periods_ = 0;
};

}  // namespace nao
