#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "daemons/play/play_core.h"
#include "daemons/play/robot_viewer.h"
#include "sim/closed_loop/closed_loop.h"
#include "tools/nao-trial/trial_perception.h"

namespace nao::trial {

/** Behaviors and perception of one robot of a closed loop. */
class PlayingRobot {
 public:
  /** @param trial  Must outlive this. @param scene  Its name. @param start  Assumed pose of the
   * robot on the field. */
  PlayingRobot(ClosedLoop& trial, const std::string& scene, const Pose2& start);

  /** Sets what the robot perceives from now on. */
  void set_perception(std::unique_ptr<TrialPerception> perception);

  const play::PlayCore& core() const { return core_; }
  const play::Vision& vision() const { return vision_; }
  /** Camera whose images are requested; empty: none. */
  const std::string& camera() const { return camera_; }

  /** Commands a behavior repeatedly. */
  void command(Behavior behavior);
  /** Sets what it knows of a match from now on. */
  void set_match(const std::optional<play::MatchView>& match) { match_ = match; }
  /** After one tick of the closed loop. */
  void step();

  /** How the behavior ended; accepted while it continues. */
  const CommandResult& result() const { return result_; }
  /** Actions that were commanded. */
  int num_actions() const { return num_actions_; }
  int num_falls() const { return num_falls_; }

 private:
  play::PlayInput make_input();

  ClosedLoop& trial_;
  play::RobotViewer viewer_;
  play::PlayCore core_;
  std::unique_ptr<TrialPerception> perception_;
  play::Vision vision_;
  std::optional<play::MatchView> match_;
  std::string camera_;
  PlayCommand command_;
  double next_step_ = 0;
  double next_command_ = 0;
  CommandResult result_;
  int num_actions_ = 0;
  int64_t last_action_id_ = 0;
  int num_falls_ = 0;
  bool is_fallen_ = false;
};

/** Places a robot as it stands, turned about the vertical axis; its odometry begins there. */
void place_standing(ClosedLoop& trial, const Pose2& pose);

/** Simulator, motion core, perception and behaviors in one process. */
class PlayTrial {
 public:
  /** @param robot_in_field  Where the robot stands at the start. @param start  Its assumed pose.
   * @param ball  m, on the field. */
  PlayTrial(const ClosedLoopOptions& options, uint64_t seed, const PerceptionFactory& perception,
            const Pose2& robot_in_field, const Pose2& start, const Eigen::Vector2d& ball);

  ClosedLoop& trial() { return trial_; }
  const play::PlayCore& core() const { return robot_.core(); }
  void command(Behavior behavior) { robot_.command(behavior); }
  const CommandResult& result() const { return robot_.result(); }
  int num_actions() const { return robot_.num_actions(); }
  int num_falls() const { return robot_.num_falls(); }

  /** One tick. */
  void step();

  /** If there is a trace: line of a CSV file for now, see write_trace(). */
  void trace();
  /** Writes what trace() kept: time, phase, reason, true robot and ball, the ball as known. */
  void write_trace(const std::string& file) const;

 private:
  ClosedLoop trial_;
  PlayingRobot robot_;
  std::string trace_;
};

}  // namespace nao::trial
