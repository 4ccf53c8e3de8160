#pragma once

#include <Eigen/Geometry>

namespace nao {

/** A collision primitive: all points within a radius of a box (the inner box).
 *
 * With extents 0 it is a sphere, with one extent (z) a capsule, and with three a box with rounded
 * edges. The contact normal of two of them is the shortest line between their inner boxes, which
 * exists while they overlap by less than the sum of their radii: contact forces keep the overlap
 * far smaller. */
struct RoundedBox {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  /** Half edge lengths of the inner box, m; any may be 0. */
  Eigen::Vector3d half = Eigen::Vector3d::Zero();
  /** m. */
  double radius = 0;
};

/** The closest points of two shapes, or the least overlap. */
struct Proximity {
  /** Distance between the surfaces, m; negative if they overlap. */
  double distance = 0;
  /** Unit vector from b to a: moving a along it increases the distance. */
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
  /** Midpoint between the closest points of the surfaces. */
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
};

/** Closest points of two shapes: in closed form for spheres and capsules, otherwise by the
 * algorithm of Gilbert, Johnson and Keerthi (IEEE Journal of Robotics and Automation 4(2), 1988).
 * For inner boxes that overlap, the axis of least overlap (separating axes; Gottschalk, Lin,
 * Manocha, 1996).
 *
 * Implemented here because the physics needs it without allocation, with rounded boxes, and with
 * the same bits everywhere; no packaged library (FCL, libccd) offers these together. */
Proximity closest_points(const RoundedBox& a, const RoundedBox& b);

}  // namespace nao
