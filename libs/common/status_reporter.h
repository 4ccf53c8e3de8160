#pragma once

#include <string>
#include <utility>
#include <vector>

#include "common/bus.h"

namespace nao {

/** Publishes a program's daemon_status_t and notifies systemd. Call tick() in every period of the
 * main loop and publish() once a second. */
class StatusReporter {
 public:
  /** @param program, robot  Names as in daemon_status_t: "nao-motion", "NAO". The bus must outlive
   * this. */
  StatusReporter(Bus& bus, std::string program, std::string robot = "");

  /** Records one period of the main loop at `now`, s of the monotonic clock. */
  void tick(double now);

  /** State of the program: "starting", "ready", "waiting" or "stopping", with an explanation. */
  void set_state(const std::string& state, const std::string& detail = "");

  /** Sends the status; loop periods are those since the last call.
   * @param metrics  Additional metrics of the program; their names include units. */
  void publish(const std::vector<std::pair<std::string, double>>& metrics = {});

 private:
  Bus& bus_;
  std::string program_;
  std::string robot_;
  std::string host_;
  std::string state_ = "starting";
  std::string detail_;
  double last_tick_ = 0;
  double period_sum_ = 0;
  double period_worst_ = 0;
  int num_periods_ = 0;
};

}  // namespace nao
