#include "rendering/facing_triangles.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "rendering/primitives.h"

namespace nao {
namespace {

/** Number of triangles whose front is seen from a point, one by one. */
int count_facing(const Mesh& mesh, const Eigen::Vector3f& eye) {
  int count = 0;
  for (size_t i = 0; i < mesh.indices.size(); i += 3) {
    const auto corner = [&](size_t number) {
      return mesh.vertices[mesh.indices[i + number]].position;
    };
    const Eigen::Vector3f normal = (corner(1) - corner(0)).cross(corner(2) - corner(0));
    count += normal.dot(eye - corner(0)) > 0 ? 1 : 0;
  }
  return count;
}

TEST(FacingTriangles, AreThoseOfThreeSidesOfABox) {
  const FacingTriangles facing(make_box({1, 1, 1}, Color::Ones()));
  std::vector<uint32_t> indices;
  facing.append({3, 4, 5, 1}, indices);
  EXPECT_EQ(indices.size(), 3U * 2 * 3);
  facing.append({1, 0, 0, 0}, indices);  // a direction: one side
  EXPECT_EQ(indices.size(), 3U * 2 * 3 + 2 * 3);
}

TEST(FacingTriangles, AreAllThatAnEyeSeesOfASphere) {
  const Mesh mesh = make_sphere(0.1f, Color::Ones(), 32);
  const FacingTriangles facing(mesh);
  for (const Eigen::Vector3f& eye : {Eigen::Vector3f(0.3f, 0, 0.1f), {-2, 1, 0.5f}, {0, 0, 0}}) {
    std::vector<uint32_t> indices;
    facing.append(eye.homogeneous(), indices);
    EXPECT_EQ(static_cast<int>(indices.size() / 3), count_facing(mesh, eye)) << eye.transpose();
  }
}

}  // namespace
}  // namespace nao
