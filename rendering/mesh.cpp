#include "rendering/mesh.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace nao {

// Square roots as an approximation of the sRGB curve: 8 bits then resolve dark colors as finely as
// the screen does. Alpha is linear.
std::array<uint8_t, 4> encode_color(const Color& color) {
  std::array<uint8_t, 4> encoded{};
  for (int i = 0; i < 4; ++i) {
    const float value = std::clamp(color[i], 0.0f, 1.0f);
    encoded[i] = static_cast<uint8_t>(std::lround(255 * (i < 3 ? std::sqrt(value) : value)));
  }
  return encoded;
}

// About the center of the bounding box: not the smallest sphere, but near to it.
BoundingSphere bounding_sphere(const Mesh& mesh) {
  BoundingSphere sphere;
  if (mesh.vertices.empty()) return sphere;
  Eigen::Vector3f lower = mesh.vertices.front().position;
  Eigen::Vector3f upper = lower;
  for (const Vertex& vertex : mesh.vertices) {
    lower = lower.cwiseMin(vertex.position);
    upper = upper.cwiseMax(vertex.position);
  }
  sphere.center = (lower + upper) / 2;
  for (const Vertex& vertex : mesh.vertices) {
    sphere.radius = std::max(sphere.radius, (vertex.position - sphere.center).norm());
  }
  return sphere;
}

void append(Mesh& mesh, const Mesh& part, const Eigen::Vector3f& offset) {
  const auto first = static_cast<uint32_t>(mesh.vertices.size());
  for (Vertex vertex : part.vertices) {
    vertex.position += offset;
    mesh.vertices.push_back(vertex);
  }
  for (const uint32_t index : part.indices) mesh.indices.push_back(first + index);
}

// Vertex clustering: all vertices in one cell of a grid become one, at their mean; triangles that
// lose a corner vanish. Good enough for shadows.
Mesh simplified(const Mesh& mesh, float cell) {
  Mesh coarse;
  std::vector<int> num_merged;
  std::vector<uint32_t> renumbered;
  std::map<std::array<int, 3>, uint32_t> cells;
  for (const Vertex& vertex : mesh.vertices) {
    std::array<int, 3> key{};
    for (int axis = 0; axis < 3; ++axis) {
      key[axis] = static_cast<int>(std::floor(vertex.position[axis] / cell));
    }
    const auto [place, is_new] =
        cells.try_emplace(key, static_cast<uint32_t>(coarse.vertices.size()));
    if (is_new) {
      coarse.vertices.push_back(vertex);
      num_merged.push_back(1);
    } else {
      Vertex& merged = coarse.vertices[place->second];
      // Running mean of the positions.
      const auto weight = 1 / static_cast<float>(++num_merged[place->second]);
      merged.position += weight * (vertex.position - merged.position);
    }
    renumbered.push_back(place->second);
  }
  for (size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    const uint32_t a = renumbered[mesh.indices[i]];
    const uint32_t b = renumbered[mesh.indices[i + 1]];
    const uint32_t c = renumbered[mesh.indices[i + 2]];
    if (a != b && b != c && c != a) coarse.indices.insert(coarse.indices.end(), {a, b, c});
  }
  return coarse;
}

}  // namespace nao
