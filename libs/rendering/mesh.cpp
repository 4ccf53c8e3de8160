#include "rendering/mesh.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace nao {
namespace {

/** Cosine of the angle between two triangles, at an edge or a corner, above which the surface is
 * drawn with a crease. Chosen: cos 40 degrees; below it the NAO's rounded edges have facets. */
constexpr float kCreaseCosine = 0.77f;

/** Factor of a distance that is compared with another one, above all errors of rounding. */
constexpr float kRounding = 1.0001f;

/** Triangles of which corners at the same place, of the same color, are one vertex. A mesh has
 * several vertices there if their normals differ. */
std::vector<uint32_t> welded(const Mesh& mesh) {
  const std::array<meshopt_Stream, 2> streams{
      {{&mesh.vertices.front().position, sizeof(Eigen::Vector3f), sizeof(Vertex)},
       {&mesh.vertices.front().encoded_color, sizeof(Vertex::encoded_color), sizeof(Vertex)}}};
  std::vector<uint32_t> indices(mesh.indices.size());
  meshopt_generateShadowIndexBufferMulti(indices.data(), mesh.indices.data(), mesh.indices.size(),
                                         mesh.vertices.size(), streams.data(), streams.size());
  return indices;
}

/** Twice the area of each triangle times its unit normal. */
std::vector<Eigen::Vector3f> area_normals(const std::vector<Vertex>& vertices,
                                          const std::vector<uint32_t>& triangles) {
  std::vector<Eigen::Vector3f> normals;
  for (size_t i = 0; i + 2 < triangles.size(); i += 3) {
    const Eigen::Vector3f& corner = vertices[triangles[i]].position;
    normals.push_back((vertices[triangles[i + 1]].position - corner)
                          .cross(vertices[triangles[i + 2]].position - corner));
  }
  return normals;
}

void simplify(const std::vector<Vertex>& vertices, std::vector<uint32_t>& triangles,
              float mean_error) {
  const float* positions = vertices.front().position.data();
  // The library's errors are fractions of the mesh's extent.
  const float extent = meshopt_simplifyScale(positions, vertices.size(), sizeof(Vertex));
  triangles.resize(meshopt_simplify(triangles.data(), triangles.data(), triangles.size(), positions,
                                    vertices.size(), sizeof(Vertex), 0, mean_error / extent));
}

/** Mesh of triangles whose normals at a vertex are the mean of the triangles there, weighted by
 * area, on the same side of every crease.
 * @param triangles  Indices of `vertices`; the normals of these are not used. */
Mesh with_creases(const std::vector<Vertex>& vertices, const std::vector<uint32_t>& triangles) {
  const std::vector<Eigen::Vector3f> normals = area_normals(vertices, triangles);
  std::vector<std::vector<size_t>> triangles_at(vertices.size());
  for (size_t i = 0; i < triangles.size(); ++i) triangles_at[triangles[i]].push_back(i / 3);
  std::vector<Vertex> corners;
  for (size_t i = 0; i < triangles.size(); ++i) {
    const Eigen::Vector3f own = normals[i / 3].normalized();
    Eigen::Vector3f sum = Eigen::Vector3f::Zero();
    for (const size_t other : triangles_at[triangles[i]]) {
      if (own.dot(normals[other].normalized()) >= kCreaseCosine) sum += normals[other];
    }
    Vertex& corner = corners.emplace_back(vertices[triangles[i]]);
    // A triangle without area keeps the normal of its corner.
    if (sum.norm() > 0) corner.normal = sum.normalized();
  }
  std::vector<uint32_t> vertex_of(corners.size());
  Mesh mesh;
  mesh.vertices.resize(meshopt_generateVertexRemap(vertex_of.data(), nullptr, corners.size(),
                                                   corners.data(), corners.size(), sizeof(Vertex)));
  meshopt_remapVertexBuffer(mesh.vertices.data(), corners.data(), corners.size(), sizeof(Vertex),
                            vertex_of.data());
  mesh.indices = std::move(vertex_of);
  meshopt_optimizeVertexCache(mesh.indices.data(), mesh.indices.data(), mesh.indices.size(),
                              mesh.vertices.size());
  return mesh;
}

/** Square of the distance of a point from a triangle (C. Ericson, Real-Time Collision Detection,
 * 2005, section 5.1.5: by the Voronoi regions of corners, edges and face). */
float square_distance(const Eigen::Vector3f& point, const std::array<Eigen::Vector3f, 3>& corners) {
  const Eigen::Vector3f edge = corners[1] - corners[0];
  const Eigen::Vector3f other_edge = corners[2] - corners[0];
  const Eigen::Vector3f normal = edge.cross(other_edge);
  bool is_inside = normal.squaredNorm() > 0;
  float nearest = std::numeric_limits<float>::max();
  for (size_t i = 0; i < 3; ++i) {
    const Eigen::Vector3f& from = corners[i];
    const Eigen::Vector3f along = corners[(i + 1) % 3] - from;
    const Eigen::Vector3f to_point = point - from;
    if (normal.cross(along).dot(to_point) >= 0) continue;  // on the face's side of this edge
    is_inside = false;
    const float place =
        std::clamp(along.dot(to_point) / std::max(along.squaredNorm(), 1e-20f), 0.0f, 1.0f);
    nearest = std::min(nearest, (to_point - place * along).squaredNorm());
  }
  if (!is_inside) return nearest;
  const float height = normal.dot(point - corners[0]);
  return height * height / normal.squaredNorm();
}

}  // namespace

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

Mesh mirrored(Mesh mesh) {
  for (Vertex& vertex : mesh.vertices) {
    vertex.position.y() *= -1;
    vertex.normal.y() *= -1;
  }
  std::reverse(mesh.indices.begin(), mesh.indices.end());
  return mesh;
}

Mesh simplified(const Mesh& mesh, float mean_error) {
  if (mesh.vertices.empty()) return mesh;
  std::vector<uint32_t> triangles = welded(mesh);
  simplify(mesh.vertices, triangles, mean_error);
  return with_creases(mesh.vertices, triangles);
}

Mesh simplified_shape(const Mesh& mesh, float mean_error) {
  if (mesh.vertices.empty()) return mesh;
  Mesh shape = mesh;
  for (Vertex& vertex : shape.vertices) {
    vertex = {vertex.position, Vertex().normal, Vertex().encoded_color};
  }
  std::vector<uint32_t> vertex_of(shape.vertices.size());
  const size_t count =
      meshopt_generateVertexRemap(vertex_of.data(), shape.indices.data(), shape.indices.size(),
                                  shape.vertices.data(), shape.vertices.size(), sizeof(Vertex));
  meshopt_remapIndexBuffer(shape.indices.data(), shape.indices.data(), shape.indices.size(),
                           vertex_of.data());
  meshopt_remapVertexBuffer(shape.vertices.data(), shape.vertices.data(), shape.vertices.size(),
                            sizeof(Vertex), vertex_of.data());
  shape.vertices.resize(count);
  simplify(shape.vertices, shape.indices, mean_error);
  meshopt_optimizeVertexCache(shape.indices.data(), shape.indices.data(), shape.indices.size(),
                              shape.vertices.size());
  shape.vertices.resize(meshopt_optimizeVertexFetch(shape.vertices.data(), shape.indices.data(),
                                                    shape.indices.size(), shape.vertices.data(),
                                                    shape.vertices.size(), sizeof(Vertex)));
  return shape;
}

float largest_distance(const Mesh& mesh, const Mesh& other) {
  struct Triangle {
    std::array<Eigen::Vector3f, 3> corners;
    Eigen::Vector3f center;
    float radius;
  };
  std::vector<Triangle> triangles;
  for (size_t i = 0; i + 2 < other.indices.size(); i += 3) {
    Triangle& triangle = triangles.emplace_back();
    for (size_t j = 0; j < 3; ++j) {
      triangle.corners[j] = other.vertices[other.indices[i + j]].position;
    }
    triangle.center = (triangle.corners[0] + triangle.corners[1] + triangle.corners[2]) / 3;
    triangle.radius = 0;
    for (const Eigen::Vector3f& corner : triangle.corners) {
      triangle.radius = std::max(triangle.radius, kRounding * (corner - triangle.center).norm());
    }
  }
  float largest = 0;
  // Neighbors in a mesh are near each other: the nearest triangle of the last vertex comes first.
  size_t first = 0;
  for (const Vertex& vertex : mesh.vertices) {
    float nearest = std::numeric_limits<float>::infinity();
    float reach = nearest;
    const size_t begin = first;
    // The search may end at the first triangle that is not farther than the largest distance.
    for (size_t i = 0; i < triangles.size() && nearest > largest; ++i) {
      const size_t index = begin + i < triangles.size() ? begin + i : begin + i - triangles.size();
      const Triangle& triangle = triangles[index];
      const float bound = reach + triangle.radius;
      if ((vertex.position - triangle.center).squaredNorm() > bound * bound) continue;
      const float distance = square_distance(vertex.position, triangle.corners);
      if (distance >= nearest) continue;
      nearest = distance;
      reach = kRounding * std::sqrt(nearest);
      first = index;
    }
    largest = std::max(largest, nearest);
  }
  return std::sqrt(largest);
}

}  // namespace nao
