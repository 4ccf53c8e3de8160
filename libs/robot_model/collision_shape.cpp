#include "robot_model/collision_shape.h"

#include <algorithm>

#include "common/error.h"

namespace nao {

RoundedBox rounded_box_in_link(const Link& link, const Shape& shape, double edge_radius) {
  RoundedBox box;
  box.center = shape.pose_in_link.translation();
  box.rotation = shape.pose_in_link.linear();
  switch (shape.kind) {
    case Shape::Kind::kBox:
      // A quarter of the thinnest side at most, so that an inner box remains.
      box.radius = std::min(edge_radius, shape.size.minCoeff() / 4);
      box.half = shape.size / 2 - Eigen::Vector3d::Constant(box.radius);
      break;
    case Shape::Kind::kSphere:
      box.radius = shape.radius;
      break;
    case Shape::Kind::kCapsule:
      box.radius = shape.radius;
      box.half.z() = shape.length / 2;
      break;
    default:
      throw ModelError("link " + link.name + ": collision shape \"" + shape.name +
                       "\" must be a box, a sphere or a capsule");
  }
  return box;
}

}  // namespace nao
