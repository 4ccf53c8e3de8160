/** The NAO's generated meshes. */

#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <map>
#include <set>

#include "robot_model/robot_model.h"
#include "test/libs/robot_model/nao_robot.h"

namespace nao {
namespace {

struct Triangle {
  std::array<Eigen::Vector3d, 3> corners;
  std::array<Eigen::Vector3d, 3> normals;
  std::string material;
};

/** A link's triangles in its own frame. */
std::vector<Triangle> read_mesh(const Shape& shape) {
  const std::filesystem::path& file = shape.mesh;
  const double side = shape.is_mirrored ? -1 : 1;
  Assimp::Importer importer;
  const aiScene* scene =
      importer.ReadFile(file.string(), aiProcess_PreTransformVertices | aiProcess_Triangulate);
  if (scene == nullptr) {
    throw std::runtime_error(file.string() + ": " + importer.GetErrorString());
  }
  std::vector<Triangle> triangles;
  for (unsigned m = 0; m < scene->mNumMeshes; ++m) {
    const aiMesh& mesh = *scene->mMeshes[m];
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      Triangle triangle;
      triangle.material = scene->mMaterials[mesh.mMaterialIndex]->GetName().C_Str();
      for (int k = 0; k < 3; ++k) {
        const unsigned index = mesh.mFaces[f].mIndices[shape.is_mirrored ? 2 - k : k];
        const aiVector3D& corner = mesh.mVertices[index];
        const aiVector3D& normal = mesh.mNormals[index];
        triangle.corners[k] = {corner.x, side * corner.y, corner.z};
        triangle.normals[k] = {normal.x, side * normal.y, normal.z};
      }
      triangles.push_back(triangle);
    }
  }
  return triangles;
}

/** Triangles of every link that has any, by its name. */
const std::map<std::string, std::vector<Triangle>>& meshes() {
  static const auto all = [] {
    std::map<std::string, std::vector<Triangle>> meshes;
    for (const Link& link : nao_robot().links()) {
      for (const Shape& visual : link.visuals) {
        meshes[link.name] = read_mesh(visual);
      }
    }
    return meshes;
  }();
  return all;
}

/** Bounding box of the robot in a posture, in the torso's frame. @param counts  Whether a link of a
 * name counts. */
template <class Counts>
Eigen::AlignedBox3d box_of(const std::vector<double>& position, const Counts& counts) {
  const auto poses = nao_robot().link_poses(position);
  Eigen::AlignedBox3d box;
  for (const auto& [name, triangles] : meshes()) {
    for (const Triangle& triangle : triangles) {
      for (const Eigen::Vector3d& corner : triangle.corners) {
        if (counts(name)) {
          box.extend(poses[nao_robot().find_link(name)] * corner);
        }
      }
    }
  }
  return box;
}

std::vector<double> zero_posture() {
  return std::vector<double>(nao_robot().num_motors(), 0.0);
}

TEST(RobotMesh, CoversEveryLinkWithMassAndTheFingers) {
  EXPECT_EQ(meshes().size(), 27u);
  for (const Link& link : nao_robot().links()) {
    EXPECT_EQ(link.visuals.size(), link.mass > 0 || link.name.ends_with("Fingers") ? 1u : 0u)
        << link.name;
  }
}

TEST(RobotMesh, IsSmallEnoughForAPhoneAndASoftwareRenderer) {
  size_t num_triangles = 0;
  std::set<std::filesystem::path> files;
  for (const Link& link : nao_robot().links()) {
    for (const Shape& visual : link.visuals) {
      EXPECT_LE(meshes().at(link.name).size(), 800u) << link.name;
      num_triangles += meshes().at(link.name).size();
      files.insert(visual.mesh);
    }
  }
  EXPECT_LE(num_triangles, 17000u);
  uintmax_t num_bytes = 0;
  for (const auto& file : files) num_bytes += std::filesystem::file_size(file);
  // 0.07 MB when compressed for the phone.
  EXPECT_LE(num_bytes, 200000u);
}

TEST(RobotMesh, HasItsHeadTop573MillimetresOverItsSoles) {
  const auto box = box_of(zero_posture(), [](const std::string&) { return true; });
  EXPECT_NEAR(box.max().z() - box.min().z(), 0.573, 2e-3);
  EXPECT_NEAR(box.min().z(), -0.33309, 1e-4) << "soles";
}

TEST(RobotMesh, Is268MillimetresWideOverItsUpperArms) {
  const auto box = box_of(zero_posture(), [](const std::string& name) {
    return name.find("Wrist") == std::string::npos && name.find("ForeArm") == std::string::npos;
  });
  EXPECT_NEAR(box.sizes().y(), 0.268, 4e-3);
}

TEST(RobotMesh, EndsAtTheModelsSoles) {
  const Eigen::Vector3d sole =
      nao_robot()
          .joints()[nao_robot().links()[nao_robot().left_sole()].parent_joint]
          .pose_in_parent.translation();
  for (const Eigen::Vector2d& point : nao_robot().left_sole_outline()) {
    double nearest = 1;
    for (const Triangle& triangle : meshes().at("LFoot")) {
      for (const Eigen::Vector3d& corner : triangle.corners) {
        nearest =
            std::min(nearest, (corner - sole - Eigen::Vector3d(point.x(), point.y(), 0)).norm());
      }
    }
    // The sole's rim is bevelled by one to two millimeters.
    EXPECT_LT(nearest, 2.5e-3) << point.transpose();
  }
}

TEST(RobotMesh, HasItsCamerasAtTheirFrames) {
  for (const CameraModel& camera : nao_robot().cameras()) {
    const Link& frame = nao_robot().links()[camera.link];
    const Joint& mount = nao_robot().joints()[frame.parent_joint];
    double nearest = 1;
    for (const Triangle& triangle : meshes().at("Head")) {
      if (triangle.material == "dark") {
        const Eigen::Vector3d middle =
            (triangle.corners[0] + triangle.corners[1] + triangle.corners[2]) / 3;
        nearest = std::min(nearest, (middle - mount.pose_in_parent.translation()).norm());
      }
    }
    EXPECT_LT(nearest, 0.010) << camera.name;
  }
}

TEST(RobotMesh, IsAMirrorImage) {
  using Point = std::array<long, 3>;
  const auto corners = [](const std::string& link, int side) {
    std::multiset<Point> points;
    for (const Triangle& triangle : meshes().at(link)) {
      for (const Eigen::Vector3d& corner : triangle.corners) {
        points.insert({std::lround(corner.x() * 1e6), side * std::lround(corner.y() * 1e6),
                       std::lround(corner.z() * 1e6)});
      }
    }
    return points;
  };
  for (const auto& [name, triangles] : meshes()) {
    if (name[0] == 'L') {
      EXPECT_EQ(corners(name, 1), corners("R" + name.substr(1), -1)) << name;
    }
  }
}

TEST(RobotMesh, HasNormalsThatAgreeWithItsFaces) {
  for (const auto& [name, triangles] : meshes()) {
    for (const Triangle& triangle : triangles) {
      const Eigen::Vector3d face = (triangle.corners[1] - triangle.corners[0])
                                       .cross(triangle.corners[2] - triangle.corners[0]);
      for (const Eigen::Vector3d& normal : triangle.normals) {
        EXPECT_NEAR(normal.norm(), 1, 0.01) << name;
        EXPECT_GT(normal.dot(face), 0) << name;
      }
    }
  }
}

/** Six times the enclosed volume: positive if the faces are oriented outwards. */
TEST(RobotMesh, IsOrientedOutwards) {
  for (const auto& [name, triangles] : meshes()) {
    double volume = 0;
    for (const Triangle& triangle : triangles) {
      volume += triangle.corners[0].dot(triangle.corners[1].cross(triangle.corners[2])) / 6;
    }
    EXPECT_GT(volume, 1e-6) << name;
  }
}

TEST(RobotMesh, NamesItsColours) {
  std::set<std::string> materials;
  for (const auto& [name, triangles] : meshes()) {
    for (const Triangle& triangle : triangles) {
      materials.insert(triangle.material);
    }
  }
  EXPECT_THAT(materials, testing::ElementsAre("accent", "dark", "grey", "light", "white"));
}

}  // namespace
}  // namespace nao
