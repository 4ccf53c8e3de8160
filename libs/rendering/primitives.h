#pragma once

#include "rendering/mesh.h"

namespace nao {

/** Solids centered at the origin. Lengths in m; `num_sides` is the number of corners of a circle.
 */
Mesh make_box(const Eigen::Vector3f& size, const Color& color);
Mesh make_sphere(float radius, const Color& color, int num_sides = 24);
/** Axis along z. */
Mesh make_cylinder(float radius, float height, const Color& color, int num_sides = 24);
/** Axis along z. @param length  Between the centers of the two hemispheres. */
Mesh make_capsule(float radius, float length, const Color& color, int num_sides = 24);
/** From the origin along z to z = 1. @param radius  Radius of the shaft. */
Mesh make_arrow(float radius, const Color& color, int num_sides = 12);

}  // namespace nao
