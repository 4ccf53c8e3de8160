#include "common/status_reporter.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <naolcm/daemon_status_t.hpp>

#include "common/channels.h"
#include "common/program.h"
#include "common/service_manager.h"
#include "common/wall_clock.h"

namespace nao {

StatusReporter::StatusReporter(Bus& bus, std::string program, std::string robot)
    : bus_(bus), program_(std::move(program)), robot_(std::move(robot)) {
  std::array<char, 256> host{};
  if (gethostname(host.data(), host.size() - 1) == 0) host_ = host.data();
}

// Mean and worst period between two ticks since the last status.
void StatusReporter::tick(double now) {
  if (last_tick_ > 0) {
    const double period = now - last_tick_;
    period_sum_ += period;
    period_worst_ = std::max(period_worst_, period);
    ++num_periods_;
  }
  last_tick_ = now;
}

void StatusReporter::set_state(const std::string& state, const std::string& detail) {
  state_ = state;
  detail_ = detail;
}

void StatusReporter::publish(const std::vector<std::pair<std::string, double>>& metrics) {
  naolcm::daemon_status_t status;
  status.wall_utime = wall_utime();
  status.program = program_;
  status.robot = robot_;
  status.host = host_;
  status.process_id = getpid();
  status.version = version();
  status.state = state_;
  status.detail = detail_;
  status.loop_period_mean = num_periods_ > 0 ? period_sum_ / num_periods_ : 0;
  status.loop_period_worst = period_worst_;
  status.num_messages_in = bus_.counters().num_in;
  status.num_messages_out = bus_.counters().num_out;
  status.num_messages_dropped = bus_.counters().num_dropped;
  status.num_metrics = static_cast<int>(metrics.size());
  for (const auto& [name, value] : metrics) {
    status.metric_names.push_back(name);
    status.metric_values.push_back(value);
  }
  bus_.publish(kDaemonStatusChannel, status);
  notify_service_manager(state_, detail_);
  period_sum_ = 0;
  period_worst_ = 0;
  num_periods_ = 0;
}

}  // namespace nao
