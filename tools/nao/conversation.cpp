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
                           const std::string& program, const CommandTiming& timing)
    : name_(std::move(name)),
      source_("nao." + std::to_string(getpid())),
      command_id_(wall_utime()),
      bus_(common.lcm_url),
      channels_(common.robot),
      commands_(bus_, channels_),
      exchange_(program, monotonic_seconds(), timing) {
  loop_.on_readable(bus_.descriptor(), [this] { bus_.handle(); });
  take_results(channels_.command_result);
  if (program != "nao-motion") return;
  bus_.subscribe<naolcm::motion_state_t>(channels_.motion_state, Bus::Queue::kLatest,
                                         [this](const naolcm::motion_state_t&) {
                                           exchange_.handle_sign_of_life(monotonic_seconds());
                                         });
}

void Conversation::take_results(const std::string& channel) {
  bus_.subscribe<naolcm::command_result_t>(channel, Bus::Queue::kAll, [this](const auto& result) {
    if (result.source != source_ || result.command_id != command_id_) return;
    handle_result(static_cast<ResultStatus>(result.status), result.reason);
  });
}

int Conversation::run_walk(naolcm::walk_command_t command, double duration) {
  const double start = monotonic_seconds();
  double end = start + duration;
  const auto step = [&] {
    const double now = monotonic_seconds();
    if (now >= end) command.vx = command.vy = command.wz = 0;
    if (exchange_.should_send(now)) {
      commands_.publish(channels_.walk_command, command, source_, command_id_);
    }
    if (exchange_.outcome(now)) loop_.stop("end");
  };
  loop_.every(0.02, step);
  std::string why = loop_.run();
  const auto outcome = exchange_.outcome(monotonic_seconds());
  if (why == "end" && outcome && outcome->is_success && monotonic_seconds() < end) {
    std::fprintf(stderr,
                 "nao: walk: ended before its time: this program was held up, and a robot that "
                 "hears nothing stands\n");
    return 1;
  }
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
