#include "common/second_process.h"

#include <unistd.h>

#include <array>
#include <cstdlib>
#include <naolcm/daemon_status_t.hpp>
#include <utility>

#include "common/channels.h"
#include "common/logger.h"

namespace nao {
namespace {

/** Silence after which a program has ended, s: daemon_status_t. */
constexpr double kSilence = 3;
/** Age of a status, us, beyond which it is from a recording that is played. Chosen: far above the
 * difference of clocks in a network. */
constexpr int64_t kMaxAge = 60'000'000;

}  // namespace

SecondProcess::SecondProcess(Bus& bus, const std::string& program, const std::string& robot,
                             std::function<double()> clock)
    : clock_(std::move(clock)), start_(clock_()) {
  std::array<char, 256> own_host{};
  (void)gethostname(own_host.data(), own_host.size() - 1);
  bus.subscribe<naolcm::daemon_status_t>(
      kDaemonStatusChannel, Bus::Queue::kAll,
      [this, &bus, program, robot, host = std::string(own_host.data())](const auto& status) {
        const bool is_own = status.host == host && status.process_id == getpid();
        if (status.program != program || status.robot != robot || is_own) return;
        const bool is_new = describe().empty();
        text_ = "a second " + program + (robot.empty() ? "" : " of robot " + robot) +
                " is on this bus: host " + status.host + ", process " +
                std::to_string(status.process_id);
        last_heard_ = clock_();
        was_first_ |= last_heard_ - start_ < kSilence &&
                      std::abs(wall_utime() - status.wall_utime) < kMaxAge &&
                      status.num_messages_out > bus.counters().num_out;
        if (is_new) logger::error("{}; end one of them, or give it a bus of its own", text_);
      });
}

std::string SecondProcess::describe() const {
  return clock_() - last_heard_ < kSilence ? text_ : "";
}

}  // namespace nao
