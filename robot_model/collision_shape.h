#pragma once

#include "robot_model/closest_points.h"
#include "robot_model/robot_model.h"

namespace nao {

/** A link's collision shape as a rounded box in the link's frame.
 *
 * @param edge_radius  What a box's edges are rounded to, m; at most a quarter of its least edge.
 * @throws ModelError  unless the shape is a box, a sphere or a capsule. */
RoundedBox rounded_box_in_link(const Link& link, const Shape& shape, double edge_radius);

}  // namespace nao
