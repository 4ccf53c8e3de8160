#pragma once

#include <Eigen/Core>
#include <vector>

#include "daemons/play/play_parameters.h"
#include "kinematics/pose2.h"
#include "messages/command.h"

namespace nao::play {

/** Remembers where other robots were seen recently. */
class RobotMemory {
 public:
  explicit RobotMemory(const PlayParameters::RobotMemory& parameters) : parameters_(parameters) {}

  /** @param robots  m, in the odometry frame. @param time  Robot time, s. */
  void add(const std::vector<Eigen::Vector2d>& robots, double time);
  void forget(double time);
  /** In the odometry frame, m. */
  std::vector<Eigen::Vector2d> positions() const;

 private:
  struct Seen {
    Eigen::Vector2d position;
    double time = 0;
  };
  PlayParameters::RobotMemory parameters_;
  std::vector<Seen> seen_;
};

/** Removes from the walk what would lead to a collision: near another robot the velocity towards it
 * falls to zero, and the robot passes on the side that is nearer to its path.
 * @param robots  m, in the odometry frame. @param feet  In the odometry frame. */
WalkCommand keep_clear(WalkCommand walk, const std::vector<Eigen::Vector2d>& robots,
                       const Pose2& feet, const PlayParameters::RobotMemory& parameters);

}  // namespace nao::play
