#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

namespace nao {

/** A joint of a URDF, as order_joints() needs it. */
struct UrdfEdge {
  std::string joint;
  std::string parent;
  std::string child;
  /** The joint moves, or its child has a mass or a collision shape. */
  bool is_body = false;
  /** Place of the joint: origin, m, rotation (quaternion) and axis. */
  std::array<double, 10> place{};
};

/** The joints in an order that does not depend on their names or on the file's order.
 *
 * Depth first from the root: the body without limbs, the left arm, the left leg, the right leg, the
 * right arm; among equals by their places. Then the pure frames, such as those of sensors.
 *
 * @param limb_of_link  Rank of the limb that ends at a link: 1 left arm, 2 left leg, 3 right leg, 4
 *   right arm; a joint has the least rank of the limbs beyond it. */
std::vector<UrdfEdge> order_joints(const std::string& root, const std::vector<UrdfEdge>& edges,
                                   const std::map<std::string, int>& limb_of_link);

}  // namespace nao
