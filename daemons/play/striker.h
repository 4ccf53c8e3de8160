#pragma once

#include <optional>

#include "daemons/play/approach.h"
#include "daemons/play/ball_memory.h"
#include "daemons/play/ball_search.h"
#include "daemons/play/shot_aim.h"
#include "daemons/play/situation.h"

namespace nao::play {

/** Goes to the ball and, as the task says, kicks it, dribbles it, or kicks it until it is in the
 * opponent's goal. */
class Striker : public BehaviorMachine {
 public:
  enum class Task { kGoToBall, kKick, kDribble, kScore };

  /** @param constants  Must outlive this.
   * @param target  Where the ball shall go, m, in the odometry frame; nothing: the opponent's goal.
   * @param kicks_in_passing  Far from the goal the ball is kicked during the walk: earlier, but
   * less far and less accurately. */
  Striker(const PlayConstants& constants, Task task, const std::optional<Eigen::Vector2d>& target,
          bool kicks_in_passing = false)
      : constants_(constants),
        parameters_(constants.parameters.striker),
        task_(task),
        target_(target),
        kicks_in_passing_(kicks_in_passing),
        memory_(constants.parameters.ball_memory) {}

  Decision step(const Situation& situation) override;
  void restart() override;

 private:
  enum class Stage { kApproach, kSettle, kPush, kWatch };

  void handle_end(const CommandResult& result, const Situation& situation);
  /** The ball if it may still be where it was seen; for a rolling ball, where it will be. */
  std::optional<Ball> find_ball(const Situation& situation) const;
  Aim calc_aim(const Eigen::Vector2d& ball, const Situation& situation) const;
  /** Kicks during the walk a ball that is well placed and need not go far. */
  std::optional<Decision> kick_in_passing(const Ball& ball, const Aim& aim,
                                          const Situation& situation);
  /** The nearest point of the field, m, in the odometry frame. @param margin  From its lines, m. */
  Eigen::Vector2d into_field(const Eigen::Vector2d& point, double margin,
                             const Situation& situation) const;
  ApproachGoal make_goal(const Eigen::Vector2d& ball, const Aim& aim, const Pose2& feet);
  std::optional<Decision> find_end(const Ball& ball, const Situation& situation) const;
  static Decision look_at_candidate(const Ball& ball);
  Decision look_for_ball(const Situation& situation);
  Decision approach(const Ball& ball, const Situation& situation);
  Decision settle(const Ball& ball, const Situation& situation);
  Decision push(const Ball& ball, const Situation& situation);
  Decision watch(const Situation& situation);
  void look_at(const Ball& ball, const Situation& situation, Decision& decision) const;

  const PlayConstants& constants_;
  const PlayParameters::Striker& parameters_;
  Task task_;
  std::optional<Eigen::Vector2d> target_;
  bool kicks_in_passing_;
  BallMemory memory_;
  BallSearch search_;
  Stage stage_ = Stage::kApproach;
  double stage_start_ = 0;
  /** Time at which the robot stood still before a kick, s; nothing if it still walks. */
  std::optional<double> still_since_{};
  int num_settles_ = 0;
  /** The aim for which the robot has stopped. It is kept, since the wider side of a keeper may
   * change with each sighting. */
  Aim settled_aim_{};
  /** 1: the left foot is to kick. */
  double side_ = 0;
  /** Ball and direction of the kick in progress, in the odometry frame, and its start, s. */
  Eigen::Vector2d kicked_ball_ = Eigen::Vector2d::Zero();
  double kick_heading_ = 0;
  double kick_start_ = 0;
  bool is_passing_ = false;
  /** Time before which sightings do not count, since they are from before a kick, s. */
  double ignore_before_ = -1e9;
  /** Where a kicked ball probably is. */
  std::optional<Eigen::Vector2d> expected_{};
};

}  // namespace nao::play
