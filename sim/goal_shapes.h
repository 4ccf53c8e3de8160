#pragma once

#include <vector>

#include "robot_model/closest_points.h"
#include "robot_model/scene_file.h"

namespace nao::sim {

/** A collision shape fixed in the world. */
struct StaticShape {
  RoundedBox shape;
  /** A net stops the ball without rebound; robots pass through it. */
  bool is_net = false;
};

/** Posts, crossbars and nets of a scene's two goals, in W; empty for a scene without goals. */
std::vector<StaticShape> make_goal_shapes(const SceneFile& scene);

}  // namespace nao::sim
