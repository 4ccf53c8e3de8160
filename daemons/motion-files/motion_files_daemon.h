#pragma once

#include <deque>
#include <filesystem>
#include <future>
#include <set>
#include <string>
#include <utility>

#include "common/bus.h"
#include "common/channels.h"
#include "common/event_loop.h"
#include "common/status_reporter.h"
#include "daemons/motion-files/motion_checker.h"
#include "daemons/motion-files/motion_file_core.h"
#include "robot_model/robot_model.h"

namespace nao::motion_files {

/** The core on the bus. Answers NAO_MOTION_FILE_COMMAND, lists the motions once a second, and
 * announces them to nao-motion on NAO_KEYFRAME_MOTION. */
class MotionFilesDaemon {
 public:
  /** @param bus, loop, model  Must outlive this. @param options  Options of the simulations that
   * check.
   * @param robot  Prefix of its channels. */
  MotionFilesDaemon(Bus& bus, EventLoop& loop, const RobotModel& model,
                    const ClosedLoopOptions& options, const std::filesystem::path& folder,
                    const std::string& robot);
  ~MotionFilesDaemon();
  MotionFilesDaemon(const MotionFilesDaemon&) = delete;
  MotionFilesDaemon& operator=(const MotionFilesDaemon&) = delete;

  const MotionFileCore& core() const { return core_; }

 private:
  /** Starts and ends checks, publishes what is due. */
  void step();
  void announce(const std::string& name);
  void announce_due(double now);
  /** Announces the motions in turn, so that nao-motion also receives one whose message was lost. */
  void announce_next();
  void publish_list();
  void publish_status();

  struct Announcement {
    /** s. */
    double time;
    std::string name;
  };

  Bus& bus_;
  EventLoop& loop_;
  /** Timer that calls step(). */
  int step_timer_ = -1;
  RobotChannels channels_;
  StatusReporter status_;
  MotionFileCore core_;
  MotionChecker checker_;
  /** A check in a thread of its own: the loop must answer while a motion is simulated. It owns
   * nothing but checker_. */
  std::future<MotionReport> check_;
  std::deque<Announcement> announcements_;
  /** Name announced last in turn. */
  std::string last_announced_;
  /** Host and process id of every nao-motion that was told all motions. */
  std::set<std::pair<std::string, int>> motion_processes_;
  int num_checks_ = 0;
};

}  // namespace nao::motion_files
