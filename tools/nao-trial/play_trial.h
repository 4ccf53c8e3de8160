#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "closed_loop/closed_loop.h"
#include "daemons/play/play_core.h"
#include "daemons/play/robot_viewer.h"
#include "tools/nao-trial/trial_perception.h"

namespace nao::trial {

/** Simulator, motion core, perception and behaviors in one process. */
class PlayTrial {
 public:
  /** @param robot_in_field  Where the robot stands at the start. @param start  Where it believes to
   * stand. @param ball  m, on the field. */
  PlayTrial(const ClosedLoopOptions& options, uint64_t seed, const PerceptionFactory& perception,
            const Pose2& robot_in_field, const Pose2& start, const Eigen::Vector2d& ball);

  ClosedLoop& trial() { return trial_; }
  const play::PlayCore& core() const { return core_; }

  /** Commands a behavior, again and again. */
  void command(Behavior behavior);
  /** One tick. */
  void step();

  /** How the behavior ended; accepted while it goes on. */
  const CommandResult& result() const { return result_; }
  /** Actions that were commanded. */
  int num_actions() const { return num_actions_; }
  int num_falls() const { return num_falls_; }
  /** If there is a trace: line of a CSV file for now, see write_trace(). */
  void trace();
  /** Writes what trace() kept: time, phase, reason, true robot and ball, the ball as known. */
  void write_trace(const std::string& file) const;

 private:
  play::PlayInput make_input();

  ClosedLoop trial_;
  play::RobotViewer viewer_;
  play::PlayCore core_;
  std::unique_ptr<TrialPerception> perception_;
  play::Vision vision_;
  std::string camera_;
  PlayCommand command_;
  double next_step_ = 0;
  double next_command_ = 0;
  CommandResult result_;
  int num_actions_ = 0;
  int64_t last_action_id_ = 0;
  int num_falls_ = 0;
  bool is_fallen_ = false;
  std::string trace_;
};

}  // namespace nao::trial
