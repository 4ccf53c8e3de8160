#pragma once

#include <Eigen/Core>
#include <vector>

#include "kinematics/pose2.h"
#include "messages/command.h"

namespace nao::gateway {

/** A polygon that a walking robot does not leave: the velocity towards each edge falls to zero
 * before it. The edges may turn both ways, and do not cross. Points are m, in the fence's frame. */
class Fence {
 public:
  /** @param corners  In order, at least three; empty: no fence. */
  explicit Fence(std::vector<Eigen::Vector2d> corners = {}) : corners_(std::move(corners)) {}

  bool is_set() const { return !corners_.empty(); }
  bool contains(const Eigen::Vector2d& point) const;
  /** The part of a velocity that the robot may walk at. Outside, only back and turns. */
  WalkCommand limit(const WalkCommand& velocity, const Pose2& robot) const;
  /** Whether a straight way stays inside, with the distance at which a walk stops. */
  bool allows_way(const Eigen::Vector2d& from, const Eigen::Vector2d& to) const;

 private:
  std::vector<Eigen::Vector2d> corners_;
};

/** On which side of the line through a and b a point is: by its sign. */
double side_of_line(const Eigen::Vector2d& a, const Eigen::Vector2d& b,
                    const Eigen::Vector2d& point);

/** Whether two line segments cross: a gate is passed. */
bool do_cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c,
              const Eigen::Vector2d& d);

}  // namespace nao::gateway
