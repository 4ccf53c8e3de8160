#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "sim/ball.h"
#include "sim/sim_robot.h"

namespace nao::sim {

/** Everything that moves in a world, shared by the parts of a time step. The degrees of freedom of
 * the solver's vector are the robots', one after the other, and then the ball's. */
struct MovingBodies {
  std::vector<std::unique_ptr<SimRobot>> robots;
  /** Empty in a scene without a ball. */
  std::optional<Ball> ball;

  int num_robots() const { return static_cast<int>(robots.size()); }
};

}  // namespace nao::sim
