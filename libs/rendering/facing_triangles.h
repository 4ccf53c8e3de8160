#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "rendering/mesh.h"

namespace nao {

/** Finds the triangles of a mesh that face an eye or a light. The graphics driver leaves the others
 * out, too, but only after it has transformed their vertices, which for a small triangle is a
 * software renderer's most expensive step. */
class FacingTriangles {
 public:
  explicit FacingTriangles(const Mesh& mesh);

  /** Appends three indices for each triangle that faces a point (x, y, z, 1), m, or a direction (x,
   * y, z, 0), in the frame of the mesh. */
  void append(const Eigen::Vector4f& from, std::vector<uint32_t>& indices) const;

 private:
  /** For each triangle the plane through it: its outward normal, and the negative of its distance
   * from the origin along the normal. */
  Eigen::Matrix<float, Eigen::Dynamic, 4> planes_;
  std::vector<uint32_t> indices_;
};

}  // namespace nao
