#include "tools/nao/conversation.h"

#include <unistd.h>

#include <cstdio>
#include <naolcm/command_result_t.hpp>
#include <naolcm/motion_state_t.hpp>
#include <utility>

#include "common/command_line.h"

namespace nao {

void add_wait_options(CommandLine& command, WaitOptions& wait) {
  command.add_option("--wait", wait.timeout, "Maximum time to wait for the end, s")->positive();
  command.add_flag("--no-wait", wait.accepts_only, "Return as soon as the robot accepts it");
}

Conversation::Conversation(const CommonOptions& common, std::string name,
                           const std::string& program)
    : name_(std::move(name)),
      source_("nao." + std::to_string(getpid())),
      command_id_(wall_utime()),
      bus_(common.lcm_url),
      channels_(common.robot),
      exchange_(program, monotonic_seconds()) {
  loop_.on_readable(bus_.descriptor(), [this] { bus_.handle(); });
  bus_.subscribe<naolcm::command_result_t>(
      channels_.command_result, Bus::Queue::kAll, [this](const naolcm::command_result_t& result) {
        if (result.source == source_ && result.command_id == command_id_) {
          exchange_.handle_result(static_cast<ResultStatus>(result.status), result.reason,
                                  monotonic_seconds());
        }
      });
  if (program != "nao-motion") return;
  bus_.subscribe<naolcm::motion_state_t>(channels_.motion_state, Bus::Queue::kLatest,
                                         [this](const naolcm::motion_state_t&) {
                                           exchange_.handle_sign_of_life(monotonic_seconds());
                                         });
}

int Conversation::run_walk(naolcm::walk_command_t command, double duration) {
  constexpr double kSendPeriod = 0.1;  // s, as the gateway's; a walk command expires after 0.5 s
  const double start = monotonic_seconds();
  double end = start + duration;
  double last_sent = -kForever;
  const auto step = [&] {
    const double now = monotonic_seconds();
    if (now >= end) command.vx = command.vy = command.wz = 0;
    if (now - last_sent >= kSendPeriod) {
      publish(channels_.walk_command, command);
      last_sent = now;
    }
    if (exchange_.outcome(now)) loop_.stop("end");
  };
  loop_.every(0.02, step);
  std::string why = loop_.run();
  if (why != "end" && exchange_.is_accepted()) {
    // First Ctrl-C: command zero velocity and wait until the robot stands. A second one ends the
    // waiting.
    end = monotonic_seconds();
    step();
    why = loop_.run();
  }
  return report(why, start);
}

int Conversation::report(const std::string& why_ended, double start) {
  const double now = monotonic_seconds();
  const auto outcome = exchange_.outcome(now);
  if (outcome && !outcome->is_success) {
    std::fprintf(stderr, "nao: %s: %s%s%s\n", name_.c_str(), outcome->status.c_str(),
                 outcome->reason.empty() ? "" : ": ", outcome->reason.c_str());
    return 1;
  }
  if (!outcome && why_ended != "end") {
    std::fprintf(stderr, "nao: %s: stopped waiting; \"nao stop\" ends the motion\n", name_.c_str());
    return 1;
  }
  std::printf("%s: %s (%.1f s)\n", name_.c_str(), outcome ? "done" : "accepted", now - start);
  return 0;
}

}  // namespace nao
