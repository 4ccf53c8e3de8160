#pragma once

#include <vector>

#include "messages/command.h"

namespace nao::gateway {

/** A point on the ground, m, in the fence's frame. */
struct GroundPoint {
  double x = 0;
  double y = 0;
};

/** Where the robot is: m, and its heading, rad, in the fence's frame. */
struct GroundPose {
  double x = 0;
  double y = 0;
  double theta = 0;
};

/** A polygon that a walking robot does not leave: the velocity towards each edge falls to zero
 * before it. The edges may turn both ways, and do not cross. */
class Fence {
 public:
  /** @param corners  In order, at least three; empty: no fence. */
  explicit Fence(std::vector<GroundPoint> corners = {}) : corners_(std::move(corners)) {}

  bool is_set() const { return !corners_.empty(); }
  bool contains(const GroundPoint& point) const;
  /** The part of a velocity that the robot may walk at. Outside, only back and turns. */
  WalkCommand limit(const WalkCommand& velocity, const GroundPose& robot) const;
  /** Whether a straight way stays inside, with the distance at which a walk stops. */
  bool allows_way(const GroundPoint& from, const GroundPoint& to) const;

 private:
  std::vector<GroundPoint> corners_;
};

/** Whether two line segments cross: a gate is passed. */
bool do_cross(const GroundPoint& a, const GroundPoint& b, const GroundPoint& c,
              const GroundPoint& d);

}  // namespace nao::gateway
