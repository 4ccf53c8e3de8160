#include "rendering/primitives.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace nao {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;

/** One point of the profile of a solid of revolution about z. */
struct OutlinePoint {
  float radius;
  float z;
  /** Outward normal in the plane of the profile. */
  float normal_radius;
  float normal_z;
};

/** Solid of revolution about z. The outline runs upwards; a point that is listed twice, with two
 * normals, gives a sharp edge. */
Mesh revolve(const std::vector<OutlinePoint>& outline, const Color& color, int num_sides) {
  Mesh mesh;
  const auto encoded_color = encode_color(color);
  for (const OutlinePoint& point : outline) {
    // The seam is listed twice, at 0 and 2 pi: rows of equal length need no case for it.
    for (int side = 0; side <= num_sides; ++side) {
      const float angle = 2 * kPi * static_cast<float>(side) / static_cast<float>(num_sides);
      const float c = std::cos(angle);
      const float s = std::sin(angle);
      Vertex vertex;
      vertex.position = {point.radius * c, point.radius * s, point.z};
      vertex.normal =
          Eigen::Vector3f(point.normal_radius * c, point.normal_radius * s, point.normal_z)
              .normalized();
      vertex.encoded_color = encoded_color;
      mesh.vertices.push_back(vertex);
    }
  }
  const auto row = static_cast<uint32_t>(num_sides + 1);
  for (uint32_t i = 0; i + 1 < outline.size(); ++i) {
    for (uint32_t side = 0; side + 1 < row; ++side) {
      const uint32_t a = i * row + side;
      // At a pole, where the radius is 0, one of the two triangles has no area.
      if (outline[i].radius > 0) mesh.indices.insert(mesh.indices.end(), {a, a + 1, a + row});
      if (outline[i + 1].radius > 0) {
        mesh.indices.insert(mesh.indices.end(), {a + 1, a + row + 1, a + row});
      }
    }
  }
  return mesh;
}

/** Appends a circular arc about (0, z) from one latitude to another, rad. */
void append_arc(std::vector<OutlinePoint>& outline, float radius, float z, float from, float to,
                int num_steps) {
  for (int i = 0; i <= num_steps; ++i) {
    const float latitude =
        from + (to - from) * static_cast<float>(i) / static_cast<float>(num_steps);
    // Exactly 0 at the poles, so that revolve() recognizes them.
    const bool is_pole = std::abs(std::abs(latitude) - kPi / 2) < 1e-4f;
    const float c = is_pole ? 0 : std::cos(latitude);
    outline.push_back({radius * c, z + radius * std::sin(latitude), c, std::sin(latitude)});
  }
}

}  // namespace

Mesh make_box(const Eigen::Vector3f& size, const Color& color) {
  Mesh mesh;
  const auto encoded_color = encode_color(color);
  for (int axis = 0; axis < 3; ++axis) {
    for (const float sign : {-1.0f, 1.0f}) {
      const Eigen::Vector3f normal = sign * Eigen::Vector3f::Unit(axis);
      const Eigen::Vector3f u = Eigen::Vector3f::Unit((axis + 1) % 3);
      // Two axes of the face; normal, u and v are right-handed, so that corners run
      // counterclockwise seen from outside.
      const Eigen::Vector3f v = normal.cross(u);
      const auto first = static_cast<uint32_t>(mesh.vertices.size());
      for (const auto& [a, b] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
        Vertex vertex;
        vertex.position =
            (normal + static_cast<float>(a) * u + static_cast<float>(b) * v).cwiseProduct(size / 2);
        vertex.normal = normal;
        vertex.encoded_color = encoded_color;
        mesh.vertices.push_back(vertex);
      }
      for (const uint32_t corner : {0u, 1u, 2u, 0u, 2u, 3u}) mesh.indices.push_back(first + corner);
    }
  }
  return mesh;
}

Mesh make_sphere(float radius, const Color& color, int num_sides) {
  std::vector<OutlinePoint> outline;
  append_arc(outline, radius, 0, -kPi / 2, kPi / 2, num_sides / 2);
  return revolve(outline, color, num_sides);
}

Mesh make_cylinder(float radius, float height, const Color& color, int num_sides) {
  const float z = height / 2;
  return revolve({{0, -z, 0, -1},
                  {radius, -z, 0, -1},
                  {radius, -z, 1, 0},
                  {radius, z, 1, 0},
                  {radius, z, 0, 1},
                  {0, z, 0, 1}},
                 color, num_sides);
}

Mesh make_capsule(float radius, float length, const Color& color, int num_sides) {
  std::vector<OutlinePoint> outline;
  append_arc(outline, radius, -length / 2, -kPi / 2, 0, num_sides / 4);
  append_arc(outline, radius, length / 2, 0, kPi / 2, num_sides / 4);
  return revolve(outline, color, num_sides);
}

Mesh make_arrow(float radius, const Color& color, int num_sides) {
  // Proportions, chosen for looks: the tip takes a quarter of the length.
  constexpr float kShaft = 0.75f;
  const float head = 2.5f * radius;
  return revolve({{0, 0, 0, -1},
                  {radius, 0, 0, -1},
                  {radius, 0, 1, 0},
                  {radius, kShaft, 1, 0},
                  {radius, kShaft, 0, -1},
                  {head, kShaft, 0, -1},
                  {head, kShaft, 1 - kShaft, head},
                  {0, 1, 1 - kShaft, head}},
                 color, num_sides);
}

}  // namespace nao
