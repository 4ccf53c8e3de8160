#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

namespace nao {

/** Linear red, green, blue and opacity, each 0 to 1 (not gamma-encoded). */
using Color = Eigen::Vector4f;

/** One vertex of a triangle mesh, in the memory layout that the graphics card reads. */
struct Vertex {
  /** m, in the frame of the mesh. */
  Eigen::Vector3f position = Eigen::Vector3f::Zero();
  /** Unit vector, outwards. */
  Eigen::Vector3f normal = Eigen::Vector3f::UnitZ();
  /** Square roots of linear red, green, blue, and opacity; square roots resolve dark colors better
   * in eight bits. */
  std::array<uint8_t, 4> encoded_color{255, 255, 255, 255};
};

/** Triangles of one or more closed solids; the corners run counter-clockwise, seen from outside. */
struct Mesh {
  std::vector<Vertex> vertices;
  /** Indices into `vertices`, three for each triangle. */
  std::vector<uint32_t> indices;
};

/** Sphere that encloses a mesh, for culling. */
struct BoundingSphere {
  /** m, in the frame of the mesh. */
  Eigen::Vector3f center = Eigen::Vector3f::Zero();
  /** m. */
  float radius = 0;
};

/** Color as Vertex stores it; values outside 0 to 1 are clipped. */
std::array<uint8_t, 4> encode_color(const Color& color);

/** Sphere around all vertices about the center of their box; not the smallest possible one. */
BoundingSphere bounding_sphere(const Mesh& mesh);

/** Appends `part`, translated by `offset` (m), to `mesh`. */
void append(Mesh& mesh, const Mesh& part, const Eigen::Vector3f& offset = Eigen::Vector3f::Zero());

/** Mirror image at the plane y = 0, whose triangles face outwards again. */
Mesh mirrored(Mesh mesh);

/** Simplifies a mesh by edge collapses in the order of their quadric errors (Garland and Heckbert,
 * 1997). Creases and borders between colors are kept.
 * @param mean_error  Largest error of a collapse, m: the distance of the old surface from the new
 * one, averaged over the area around it. */
Mesh simplified(const Mesh& mesh, float mean_error);

/** As simplified(), but only the shape is kept: the result has neither colors nor normals. */
Mesh simplified_shape(const Mesh& mesh, float mean_error);

/** Largest distance of a vertex of `mesh` from the surface of `other`, m; `other` must have
 * triangles. */
float largest_distance(const Mesh& mesh, const Mesh& other);

}  // namespace nao
