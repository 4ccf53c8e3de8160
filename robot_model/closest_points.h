#pragma once

#include <Eigen/Geometry>

namespace nao {

/** A collision primitive in the world: a box, grown all around by a radius.
 *
 * With extents 0 it is a sphere, with one extent a capsule, and with three a box with rounded
 * edges. Two of them touch along the shortest line between their inner boxes, which exists as long
 * as they overlap by less than the sum of their radii: deep enough for bodies that contact forces
 * keep apart. */
struct RoundedBox {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  /** Half edge lengths of the inner box, m; any may be 0. */
  Eigen::Vector3d half = Eigen::Vector3d::Zero();
  /** m. */
  double radius = 0;
};

/** Where two shapes are nearest, or overlap least deeply. */
struct Proximity {
  /** Between the surfaces, m; negative where they overlap. */
  double distance = 0;
  /** Unit vector from b towards a: a moves apart from b along it. */
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
  /** Half way between the surfaces. */
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
};

/** Nearest points of two shapes: in closed form for spheres and capsules, else by the algorithm of
 * Gilbert, Johnson and Keerthi (1988). Inner boxes that overlap part along the axis of least
 * overlap (Gottschalk's separating axes). */
Proximity closest_points(const RoundedBox& a, const RoundedBox& b);

}  // namespace nao
