#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

namespace nao {

/** Colour as light: linear red, green, blue and opacity, each 0 to 1 (not gamma-encoded). */
using Color = Eigen::Vector4f;

/** One corner of a triangle mesh, laid out as the graphics card reads it. */
struct Vertex {
  /** m, in the mesh's frame. */
  Eigen::Vector3f position = Eigen::Vector3f::Zero();
  /** Unit vector pointing out of the solid. */
  Eigen::Vector3f normal = Eigen::Vector3f::UnitZ();
  /** Square roots of linear red, green, blue; eight bits then keep dark colours apart. */
  std::array<uint8_t, 4> encoded_color{255, 255, 255, 255};
};

/** Triangles of one or more closed solids. Seen from outside, corners run counter-clockwise. */
struct Mesh {
  std::vector<Vertex> vertices;
  /** Three for each triangle. */
  std::vector<uint32_t> indices;
};

/** Ball that holds a mesh, for telling quickly whether a camera can see it. */
struct BoundingSphere {
  /** m, in the mesh's frame. */
  Eigen::Vector3f center = Eigen::Vector3f::Zero();
  /** m. */
  float radius = 0;
};

/** Colour as Vertex stores it; values outside 0 to 1 are clipped. */
std::array<uint8_t, 4> encode_color(const Color& color);

/** A sphere around all vertices: centre of their box, not the smallest one. */
BoundingSphere bounding_sphere(const Mesh& mesh);

/** Appends `part`, moved by `offset` (m), to `mesh`. */
void append(Mesh& mesh, const Mesh& part, const Eigen::Vector3f& offset = Eigen::Vector3f::Zero());

/** A coarser mesh of nearly the same outline, for shadows: corners within one cell of a grid become
 * one, triangles that shrink to a line are left out. @param cell  Side of the grid's cells, m. */
Mesh simplified(const Mesh& mesh, float cell);

}  // namespace nao
