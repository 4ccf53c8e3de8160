#pragma once

#include <vector>

#include "rendering/mesh.h"
#include "robot_model/scene_file.h"

namespace nao {

/** Posts, crossbar and the bars that carry the net, in world coordinates.
 * @param end  1: the goal at positive x; -1: the other one. */
Mesh make_goal(const FieldDimensions& field, const GoalDimensions& goals, int end);

/** A corner of a net: position in the world, and position on the net, both m. */
struct NetCorner {
  Eigen::Vector3f position;
  Eigen::Vector2f on_net;
};

/** Nets of both goals as triangles of three corners. */
std::vector<NetCorner> make_nets(const FieldDimensions& field, const GoalDimensions& goals);

}  // namespace nao
