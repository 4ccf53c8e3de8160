#include "rendering/facing_triangles.h"

namespace nao {

FacingTriangles::FacingTriangles(const Mesh& mesh) : indices_(mesh.indices) {
  planes_.resize(static_cast<Eigen::Index>(indices_.size() / 3), 4);
  for (Eigen::Index i = 0; i < planes_.rows(); ++i) {
    const auto corner = [&](Eigen::Index number) -> const Eigen::Vector3f& {
      return mesh.vertices[indices_[static_cast<size_t>(3 * i + number)]].position;
    };
    const Eigen::Vector3f normal = (corner(1) - corner(0)).cross(corner(2) - corner(0));
    planes_.row(i) << normal.transpose(), -normal.dot(corner(0));
  }
}

// This has no branches: every triangle is written, and the next one overwrites it unless it faces
// `from`.
void FacingTriangles::append(const Eigen::Vector4f& from, std::vector<uint32_t>& indices) const {
  size_t end = indices.size();
  indices.resize(end + indices_.size());
  // Triangles whose heights lie in the first-level cache.
  constexpr Eigen::Index kBlock = 64;
  Eigen::Matrix<float, kBlock, 1> heights;
  for (Eigen::Index first = 0; first < planes_.rows(); first += kBlock) {
    const Eigen::Index size = std::min(kBlock, planes_.rows() - first);
    heights.head(size).noalias() = planes_.middleRows(first, size) * from;
    for (Eigen::Index i = 0; i < size; ++i) {
      const uint32_t* triangle = &indices_[static_cast<size_t>(3 * (first + i))];
      std::copy_n(triangle, 3, &indices[end]);
      end += heights[i] > 0 ? 3 : 0;
    }
  }
  indices.resize(end);
}

}  // namespace nao
