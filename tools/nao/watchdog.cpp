#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <naolcm/daemon_status_t.hpp>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include "common/bus.h"
#include "common/channels.h"
#include "common/command_line.h"
#include "common/event_loop.h"
#include "common/logger.h"
#include "common/status_reporter.h"
#include "common/wall_clock.h"
#include "tools/nao/bus_listener.h"
#include "tools/nao/hang_detector.h"
#include "tools/nao/subcommand.h"

namespace nao {
namespace {

/** Period of HangDetector::step(), s: far below its limits. */
constexpr double kStepPeriod = 0.4;
/** As of every program, see daemon_status_t, s. */
constexpr double kHeartbeatPeriod = 1.0;
/** Heartbeats between two searches for processes: far less than HangDetector::Limits::first_silence
 * takes. */
constexpr int kSearchHeartbeats = 5;
constexpr const char* kStackVariable = "NAO_REMOTE_STACK";

/** True if a process belongs to the same stack as this one: its environment has the same value of
 * NAO_REMOTE_STACK. False if the process has ended or is another user's. */
bool is_of_own_stack(int process_id) {
  const char* own = std::getenv(kStackVariable);
  if (own == nullptr) return false;
  std::ifstream file("/proc/" + std::to_string(process_id) + "/environ");
  const std::string environment((std::istreambuf_iterator<char>(file)), {});
  const std::string mark = std::string(kStackVariable) + "=" + own + '\0';
  const size_t place = environment.find(mark);
  return place == 0 || (place != std::string::npos && environment[place - 1] == '\0');
}

/** Calls a function with the process id and program of each process of the own stack that is one of
 * the programs. */
template <typename Function>
void for_each_process(const std::vector<std::string>& programs, const Function& function) {
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator("/proc", error)) {
    int process_id = 0;
    const std::string name = entry.path().filename();
    const auto [end, problem] = std::from_chars(name.data(), name.data() + name.size(), process_id);
    if (problem != std::errc() || *end != '\0') continue;
    // Unreadable if the process has ended or is another user's: then there is no program.
    const std::string program =
        std::filesystem::read_symlink(entry.path() / "exe", error).filename();
    if (std::find(programs.begin(), programs.end(), program) != programs.end() &&
        is_of_own_stack(process_id)) {
      function(process_id, program);
    }
  }
}

/** Looks from time to time whether two systems share the bus, as when two networks are joined. */
class SharedBusWatch {
 public:
  /** @param loop  Must outlive this. */
  SharedBusWatch(EventLoop& loop, const std::string& url)
      : loop_(loop), address_(parse_bus_address(url)) {}

  /** Call it every kStepPeriod. @return What is wrong; empty if nothing is. */
  const std::string& step(double now) {
    if (!listener_ && now >= next_start_) {
      listener_.emplace(address_);
      owners_.forget_channels();
      loop_.on_readable(listener_->descriptor(), [this] { listener_->read(owners_); });
      end_ = now + kListenTime;
    }
    if (!listener_ || now < end_) return fault_;
    loop_.forget(listener_->descriptor());
    listener_.reset();
    next_start_ = now + kListenPause;
    const std::string fault = describe();
    if (!fault.empty() && fault != fault_)
      logger::error("{}; end one of them, or give it a bus of its own", fault);
    return fault_ = fault;
  }

 private:
  /** s: longer than the period of daemon_status_t, whose sender is named. */
  static constexpr double kListenTime = 1.2;
  /** s. Chosen: listening, which every message wakes, costs 0.2 % of a core. */
  static constexpr double kListenPause = 20;

  std::string describe() const {
    std::string text;
    for (const std::string& channel : owners_.find_shared()) {
      text += (text.empty() ? "two programs publish on " : "; on ") + channel + ":";
      for (const std::string& owner : owners_.owners_of(channel)) text += " " + owner + ",";
      text.pop_back();
    }
    return text;
  }

  EventLoop& loop_;
  BusAddress address_;
  ChannelOwners owners_;
  std::optional<BusListener> listener_;
  double next_start_ = 0;
  double end_ = 0;
  std::string fault_;
};

int run_watchdog(const CommonOptions& common, const std::vector<std::string>& programs) {
  EventLoop loop;
  Bus bus(common.lcm_url);
  StatusReporter reporter(bus, "nao-watchdog");
  std::array<char, 256> host{};
  gethostname(host.data(), host.size() - 1);
  HangDetector detector({});
  SharedBusWatch shared_bus(loop, common.lcm_url);
  bool is_ready = false;
  bus.subscribe<naolcm::daemon_status_t>(
      kDaemonStatusChannel, Bus::Queue::kAll, [&](const auto& status) {
        if (status.host != host.data()) return;
        if (status.process_id == getpid()) {
          detector.handle_own_heartbeat(monotonic_seconds());
        } else if (is_of_own_stack(status.process_id)) {
          detector.handle_status(status.process_id, status.program);
        }
      });
  loop.on_readable(bus.descriptor(), [&bus] { bus.handle(); });
  loop.every(kStepPeriod, [&] {
    const double now = monotonic_seconds();
    reporter.tick(now);
    reporter.set_state(is_ready ? "ready" : "starting", shared_bus.step(now));
    if (!is_ready && detector.num_published() >= static_cast<int>(programs.size())) {
      is_ready = true;
      reporter.set_state("ready");
      reporter.publish();
    }
    for (const HangDetector::Hung& hung : detector.step(now)) {
      if (!is_of_own_stack(hung.process_id)) continue;
      logger::warn("{} (process {}) has published no status for {:.1f} s: killing it", hung.program,
                   hung.process_id, hung.silence);
      kill(hung.process_id, SIGKILL);
    }
  });
  // A program that hangs before it is known here must be found as well.
  int num_heartbeats = 0;
  const auto find_processes = [&] {
    for (const int process_id : detector.process_ids()) {
      if (!is_of_own_stack(process_id)) detector.forget(process_id);
    }
    if (num_heartbeats++ % kSearchHeartbeats == 0) {
      for_each_process(programs, [&detector](int process_id, const std::string& program) {
        detector.handle_process(process_id, program);
      });
    }
    reporter.publish();
  };
  loop.every_aligned(kHeartbeatPeriod, find_processes);
  find_processes();
  logger::info("watching the programs on {}", common.lcm_url);
  logger::info("ended by {}", loop.run());
  return 0;
}

}  // namespace

void add_watchdog_command(CommandLine& app, Invocation& invocation) {
  CommandLine* watchdog = app.add_subcommand(
      "watchdog",
      "Kill programs of the own stack that hang, so that supervisor restarts them; "
      "scripts/start runs it");
  auto programs = std::make_shared<std::vector<std::string>>();
  watchdog
      ->add_option("--programs", *programs,
                   "The stack's programs, one name for each process: the watchdog is ready when "
                   "all have published their status")
      ->separated_by(',');
  invocation.on(*watchdog,
                [programs](const auto& common) { return run_watchdog(common, *programs); });
}

}  // namespace nao
