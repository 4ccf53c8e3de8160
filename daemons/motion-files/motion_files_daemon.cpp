#include "daemons/motion-files/motion_files_daemon.h"

#include <algorithm>
#include <chrono>
#include <naolcm/daemon_status_t.hpp>

#include "common/error.h"
#include "common/logger.h"
#include "common/wall_clock.h"
#include "messages/command.h"

namespace nao::motion_files {
namespace {

constexpr const char* kMotionProgram = "nao-motion";
// Periods, s, of looking for the end of a check, of the list and the status, and of announcing one
// motion after the other. Chosen: a user does not notice the first; with the last one, a few
// hundred motions are announced within minutes.
constexpr double kStepPeriod = 0.02;
constexpr double kListPeriod = 1.0;
constexpr double kAnnouncePeriod = 0.5;
// Times after a change at which it is announced again, s: UDP may lose a message.
constexpr double kAnnounceTimes[] = {0.1, 0.5};
// Announcements in one step. Chosen: nao-motion takes 16 between two control steps.
constexpr int kAnnouncementsPerStep = 4;

}  // namespace

MotionFilesDaemon::MotionFilesDaemon(Bus& bus, EventLoop& loop, const RobotModel& model,
                                     const ClosedLoopOptions& options,
                                     const std::filesystem::path& folder, const std::string& robot)
    : bus_(bus),
      loop_(loop),
      channels_(robot),
      status_(bus, "nao-motion-files", robot),
      core_(model, folder),
      checker_(options) {
  for (const std::string& fault : core_.store().faults()) logger::warn("{}", fault);
  bus_.subscribe<naolcm::motion_file_command_t>(
      channels_.motion_file_command, Bus::Queue::kAll, [this](const auto& message) {
        const auto command = from_message(message);
        if (!command)
          throw MessageError("its operation is unknown, or its lists have unequal lengths");
        core_.receive(*command);
        step();
      });
  bus_.subscribe<naolcm::daemon_status_t>(
      kDaemonStatusChannel, Bus::Queue::kAll, [this, robot](const auto& message) {
        if (message.program != kMotionProgram || message.robot != robot) return;
        // A new nao-motion has no taught motions.
        if (!motion_processes_.insert({message.host, message.process_id}).second) return;
        for (const std::string& name : core_.store().names()) announcements_.push_back({0, name});
        step();
      });
  loop.on_readable(bus_.descriptor(), [this] { bus_.handle(); });
  step_timer_ = loop.every(kStepPeriod, [this] {
    status_.tick(monotonic_seconds());
    step();
  });
  loop.every(kAnnouncePeriod, [this] { announce_next(); });
  loop.every_aligned(kListPeriod, [this] {
    publish_list();
    publish_status();
  });
  status_.set_state("ready");
  publish_list();
  publish_status();
}

MotionFilesDaemon::~MotionFilesDaemon() {
  // A running check ends with the next simulated tick.
  checker_.cancel();
}

void MotionFilesDaemon::step() {
  if (check_.valid() && check_.wait_for(std::chrono::seconds(0)) == std::future_status::ready) {
    core_.finish(check_.get());
    ++num_checks_;
  }
  if (const auto job = core_.next_job()) {
    check_ = std::async(std::launch::async,
                        [this, script = job->script] { return checker_.check(script); });
  }
  const double now = monotonic_seconds();
  const std::vector<std::string> changes = core_.take_changes();
  for (const std::string& name : changes) {
    announce(name);
    for (const double time : kAnnounceTimes) announcements_.push_back({now + time, name});
  }
  announce_due(now);
  // After the motions, since who reads that a motion is saved may play it at once.
  for (const MotionFileResult& result : core_.take_results()) {
    logger::info("command {} of {}: {}", result.id, quoted(result.source),
                 result.is_ok ? "ok" : to_sentence(result.reason));
    bus_.publish(channels_.motion_file_result, to_message(result));
  }
  if (!changes.empty()) publish_list();
  const bool is_busy = check_.valid() || !announcements_.empty();
  loop_.set_period(step_timer_, is_busy ? kStepPeriod : kListPeriod);
}

void MotionFilesDaemon::announce(const std::string& name) {
  bus_.publish(channels_.keyframe_motion, to_message(core_.find(name)));
}

void MotionFilesDaemon::announce_due(double now) {
  int num_left = kAnnouncementsPerStep;
  for (auto it = announcements_.begin(); it != announcements_.end() && num_left > 0;) {
    if (it->time > now) {
      ++it;
      continue;
    }
    announce(it->name);
    it = announcements_.erase(it);
    --num_left;
  }
}

void MotionFilesDaemon::announce_next() {
  const std::vector<std::string> names = core_.store().names();
  if (names.empty()) return;
  const auto next = std::upper_bound(names.begin(), names.end(), last_announced_);
  last_announced_ = next == names.end() ? names.front() : *next;
  // Motions without a file last as long as the nao-motion that they were announced to.
  if (is_temporary_motion(last_announced_)) return;
  announce(last_announced_);
}

void MotionFilesDaemon::publish_list() {
  bus_.publish(channels_.motion_file_result, to_message(core_.list()));
}

void MotionFilesDaemon::publish_status() {
  status_.set_state("ready", check_.valid() ? "checks a motion" : "");
  status_.publish({{"motions", static_cast<double>(core_.store().names().size())},
                   {"checks", static_cast<double>(num_checks_)}});
}

}  // namespace nao::motion_files
