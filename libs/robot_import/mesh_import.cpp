#include "robot_import/mesh_import.h"

#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/Exporter.hpp>
#include <assimp/Importer.hpp>
#include <cctype>
#include <cmath>

#include "common/error.h"
#include "common/rotation.h"

namespace nao {
namespace {

// Least edge of a box, m: a flat mesh still has a volume.
constexpr double kLeastEdge = 1e-3;
// Least ratio of length to width of a capsule, and the greatest of its width to its depth.
constexpr double kLongRatio = 1.6;
constexpr double kRoundRatio = 1.5;

// Meshes with all transforms of the file's node tree and the URDF's scale applied.
const aiScene& read_scene(Assimp::Importer& importer, const std::filesystem::path& file,
                          const Eigen::Vector3d& scale) {
  const aiScene* scene = importer.ReadFile(
      file.string(), aiProcess_Triangulate | aiProcess_GenNormals | aiProcess_PreTransformVertices |
                         aiProcess_JoinIdenticalVertices);
  if (scene == nullptr || scene->mNumMeshes == 0) {
    throw ModelError(file.string() + ": is not a mesh: " + importer.GetErrorString());
  }
  // Collada files name their upward axis. assimp turns it to y; a link's is z.
  std::string ending = file.extension().string();
  for (char& letter : ending) letter = static_cast<char>(std::tolower(letter & 0xff));
  const bool is_turned = ending == ".dae";
  for (unsigned i = 0; i < scene->mNumMeshes; ++i) {
    aiMesh& mesh = *scene->mMeshes[i];
    for (unsigned k = 0; is_turned && k < mesh.mNumVertices; ++k) {
      for (aiVector3D* vectors : {mesh.mVertices, mesh.mNormals}) {
        if (vectors == nullptr) continue;
        vectors[k] = aiVector3D(vectors[k].x, -vectors[k].z, vectors[k].y);
      }
    }
    for (unsigned k = 0; k < mesh.mNumVertices; ++k) {
      aiVector3D& point = mesh.mVertices[k];
      point = aiVector3D(static_cast<ai_real>(point.x * scale.x()),
                         static_cast<ai_real>(point.y * scale.y()),
                         static_cast<ai_real>(point.z * scale.z()));
      if (!std::isfinite(point.x) || !std::isfinite(point.y) || !std::isfinite(point.z)) {
        throw ModelError(file.string() + ": has a corner that is not finite");
      }
    }
  }
  return *scene;
}

}  // namespace

std::vector<Eigen::Vector3d> read_mesh_points(const std::filesystem::path& file,
                                              const Eigen::Vector3d& scale) {
  Assimp::Importer importer;
  const aiScene& scene = read_scene(importer, file, scale);
  std::vector<Eigen::Vector3d> points;
  for (unsigned i = 0; i < scene.mNumMeshes; ++i) {
    const aiMesh& mesh = *scene.mMeshes[i];
    for (unsigned k = 0; k < mesh.mNumVertices; ++k) {
      points.emplace_back(mesh.mVertices[k].x, mesh.mVertices[k].y, mesh.mVertices[k].z);
    }
  }
  return points;
}

void convert_mesh(const std::filesystem::path& source, const Eigen::Vector3d& scale,
                  const std::filesystem::path& target) {
  Assimp::Importer importer;
  const aiScene& scene = read_scene(importer, source, scale);
  Assimp::Exporter exporter;
  if (exporter.Export(&scene, "glb2", target.string()) != AI_SUCCESS) {
    throw ModelError(target.string() + ": cannot be written: " + exporter.GetErrorString());
  }
}

// The axis-aligned bounding box in the mesh's own frame, or a capsule along its longest axis where
// that fits better.
FittedShape fit_shape(const std::vector<Eigen::Vector3d>& points) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& point : points) box.extend(point);
  FittedShape shape;
  shape.pose.translation() = box.center();
  shape.size = box.sizes().cwiseMax(kLeastEdge);
  Eigen::Index axis = 0;
  const double longest = shape.size.maxCoeff(&axis);
  const double a = shape.size[(axis + 1) % 3];
  const double b = shape.size[(axis + 2) % 3];
  const bool is_round = std::max(a, b) < kRoundRatio * std::min(a, b);
  if (!is_round || longest < kLongRatio * 0.5 * (a + b)) return shape;
  // The radius is half of the mean of both short sides; the ends are within the box.
  shape.is_capsule = true;
  shape.radius = 0.25 * (a + b);
  shape.length = longest - 2 * shape.radius;
  shape.pose.linear() =
      rotation_between(Eigen::Vector3d::UnitZ().eval(), Eigen::Vector3d::Unit(axis).eval())
          .toRotationMatrix();
  return shape;
}

}  // namespace nao
