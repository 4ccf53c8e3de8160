#pragma once

#include "rendering/mesh.h"

namespace nao {

/** Solids about the origin. Lengths in m; `num_sides` is the number of corners of a circle. */
Mesh make_box(const Eigen::Vector3f& size, const Color& color);
Mesh make_sphere(float radius, const Color& color, int num_sides = 24);
/** Standing along z. */
Mesh make_cylinder(float radius, float height, const Color& color, int num_sides = 24);
/** Standing along z; `length` lies between the centres of its ends. */
Mesh make_capsule(float radius, float length, const Color& color, int num_sides = 24);
/** From the origin along z to z = 1; `radius` is its shaft's. */
Mesh make_arrow(float radius, const Color& color, int num_sides = 12);

}  // namespace nao
