#pragma once

#include <string>
#include <vector>

#include "daemons/play/play_core.h"

namespace nao::play {

/** A kinematic robot, a ball on a plane, and perfect perception: executes PlayCore's commands. The
 * odometry frame is the world; the field's frame is the same until the test moves it. */
class ToyWorld {
 public:
  static constexpr double kPeriod = 0.05;

  ToyWorld();

  /** Starts to send a play command, and repeats it. */
  void command(Behavior behavior);
  void stop_commanding() { commanded_ = Behavior::kNone; }
  void step();
  /** Steps until no behavior is active. @return Time that it took, s; `timeout` if it continues. */
  double run(double timeout);

  PlayCore core;
  PlayConstants constants;
  Pose2 feet;
  Eigen::Vector2d ball{1, 0};
  Eigen::Vector2d ball_velocity = Eigen::Vector2d::Zero();
  double time = 100;
  Mode mode = Mode::kHolding;
  bool needs_help = false;
  bool has_robot = true;
  /** The camera works. */
  bool has_images = true;
  int image_status = 0;
  /** Whether the ball can be seen; nothing: it depends on the camera's direction. */
  bool is_ball_visible = true;
  /** Distance from the feet, m. */
  double sight = 4;
  std::optional<CommandKind> other_command;
  std::optional<MatchView> match;
  /** Other robots, m. */
  std::vector<Eigen::Vector2d> robots;

  // What happened.
  std::vector<CommandResult> results;
  std::vector<std::string> actions;
  std::vector<Command> commands;
  std::vector<PlayPhase> phases;
  std::vector<std::string> cameras;
  /** Least distance of the feet's middle from the ball, m, and number of steps in which the feet
   * ran over it. */
  double least_distance = 1e9;
  WalkCommand walk;

 private:
  RobotView view() const;
  void obey(const Command& command);
  void move();
  void kick(bool is_left);

  Behavior commanded_ = Behavior::kNone;
  int64_t command_id_ = 0;
  double last_command_ = -1e9;
  double last_walk_ = -1e9;
  double head_yaw_ = 0;
  double head_pitch_ = 0;
  std::vector<CommandResult> answers_;
  std::optional<Command> action_;
  double action_end_ = 0;
  std::optional<Ball> seen_;
};

}  // namespace nao::play
