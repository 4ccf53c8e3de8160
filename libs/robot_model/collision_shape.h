#pragma once

#include "robot_model/closest_points.h"
#include "robot_model/robot_model.h"

namespace nao {

/** Converts a link's collision shape to a rounded box in the link's frame.
 *
 * @param edge_radius  Radius of a box's edges, m; reduced to a quarter of the box's shortest edge.
 * @throws ModelError  unless the shape is a box, a sphere or a capsule. */
RoundedBox rounded_box_in_link(const Link& link, const Shape& shape, double edge_radius);

}  // namespace nao
