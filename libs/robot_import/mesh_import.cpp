#include "robot_import/mesh_import.h"

#include <assimp/material.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <array>
#include <assimp/Exporter.hpp>
#include <assimp/Importer.hpp>
#include <cctype>
#include <cmath>
#include <cstring>
#include <functional>
#include <memory>

#include "common/error.h"
#include "common/rotation.h"
#include "rendering/mesh.h"
#include "robot_import/limited_process.h"

namespace nao {
namespace {

// Least edge of a box, m: a flat mesh still has a volume.
constexpr double kLeastEdge = 1e-3;
// Least ratio of length to width of a capsule, and the greatest of its width to its depth.
constexpr double kLongRatio = 1.6;
constexpr double kRoundRatio = 1.5;
// Bytes that a phone receives of all meshes of a robot at most, without the network's compression.
// Chosen: a second at 40 Mbit/s.
constexpr uintmax_t kMostBytes = 5'000'000;
// Greatest error of meshes to which the bytes are reduced, m.
constexpr double kCoarsestError = 0.016;

// Meshes with all transforms of the file's node tree and the URDF's scale applied.
const aiScene& read_scene(Assimp::Importer& importer, const std::filesystem::path& file,
                          const Eigen::Vector3d& scale) {
  // Textures and colors of corners are drawn by no program here; normals follow from the triangles.
  importer.SetPropertyInteger(AI_CONFIG_PP_RVC_FLAGS,
                              aiComponent_NORMALS | aiComponent_TANGENTS_AND_BITANGENTS |
                                  aiComponent_TEXCOORDS | aiComponent_COLORS |
                                  aiComponent_TEXTURES);
  const aiScene* scene = importer.ReadFile(
      file.string(), aiProcess_RemoveComponent | aiProcess_Triangulate |
                         aiProcess_PreTransformVertices | aiProcess_JoinIdenticalVertices);
  if (scene == nullptr || scene->mNumMeshes == 0) {
    throw ModelError(std::string("is not a mesh: ") + importer.GetErrorString());
  }
  // Collada files name their upward axis. assimp turns it to y; a link's is z.
  std::string ending = file.extension().string();
  for (char& letter : ending) letter = static_cast<char>(std::tolower(letter & 0xff));
  const bool is_turned = ending == ".dae";
  for (unsigned i = 0; i < scene->mNumMeshes; ++i) {
    aiMesh& mesh = *scene->mMeshes[i];
    // A mirror image turns the corners of a triangle around.
    for (unsigned k = 0; scale.prod() < 0 && k < mesh.mNumFaces; ++k) {
      std::reverse(mesh.mFaces[k].mIndices, mesh.mFaces[k].mIndices + mesh.mFaces[k].mNumIndices);
    }
    for (unsigned k = 0; is_turned && k < mesh.mNumVertices; ++k) {
      const aiVector3D point = mesh.mVertices[k];
      mesh.mVertices[k] = aiVector3D(point.x, -point.z, point.y);
    }
    for (unsigned k = 0; k < mesh.mNumVertices; ++k) {
      aiVector3D& point = mesh.mVertices[k];
      point = aiVector3D(static_cast<ai_real>(point.x * scale.x()),
                         static_cast<ai_real>(point.y * scale.y()),
                         static_cast<ai_real>(point.z * scale.z()));
      if (!std::isfinite(point.x) || !std::isfinite(point.y) || !std::isfinite(point.z)) {
        throw ModelError("has a corner that is not finite");
      }
    }
  }
  return *scene;
}

/** Gives a part without corners those of a mesh. */
void fill(aiMesh& part, const Mesh& mesh) {
  part.mNumVertices = static_cast<unsigned>(mesh.vertices.size());
  part.mVertices = new aiVector3D[part.mNumVertices];
  part.mNormals = new aiVector3D[part.mNumVertices];
  for (unsigned i = 0; i < part.mNumVertices; ++i) {
    const Vertex& vertex = mesh.vertices[i];
    part.mVertices[i] = {vertex.position.x(), vertex.position.y(), vertex.position.z()};
    part.mNormals[i] = {vertex.normal.x(), vertex.normal.y(), vertex.normal.z()};
  }
  part.mNumFaces = static_cast<unsigned>(mesh.indices.size() / 3);
  part.mFaces = new aiFace[part.mNumFaces];
  for (unsigned i = 0; i < part.mNumFaces; ++i) {
    part.mFaces[i].mNumIndices = 3;
    part.mFaces[i].mIndices = new unsigned[3];
    std::copy_n(&mesh.indices[size_t{3} * i], 3, part.mFaces[i].mIndices);
  }
}

/** Replaces a part by one of fewer triangles. @param error  See simplified(), m. */
void simplify(aiMesh& part, double error) {
  Mesh fine;
  for (unsigned i = 0; i < part.mNumVertices; ++i) {
    const aiVector3D& point = part.mVertices[i];
    fine.vertices.emplace_back().position = {point.x, point.y, point.z};
  }
  for (unsigned i = 0; i < part.mNumFaces; ++i) {
    const aiFace& face = part.mFaces[i];
    if (face.mNumIndices != 3) continue;  // points and lines
    fine.indices.insert(fine.indices.end(), face.mIndices, face.mIndices + 3);
  }
  if (fine.indices.empty()) return;
  Mesh mesh = simplified(fine, static_cast<float>(error));
  if (mesh.indices.empty()) {
    // A part smaller than the error: one triangle, since a file's part has one at least.
    fine.indices.resize(3);
    mesh = simplified(fine, 0);
  }
  // The destructor of `old` frees what the part had.
  aiMesh old;
  std::swap(old.mVertices, part.mVertices);
  std::swap(old.mNormals, part.mNormals);
  std::swap(old.mFaces, part.mFaces);
  std::swap(old.mNumFaces, part.mNumFaces);
  fill(part, mesh);
}

void set_color(aiMaterial& material, const Color& color) {
  const aiColor4D value(color.x(), color.y(), color.z(), color.w());
  material.AddProperty(&value, 1, AI_MATKEY_BASE_COLOR);
  material.AddProperty(&value, 1, AI_MATKEY_COLOR_DIFFUSE);
}

void write_scene(const aiScene& scene, const std::filesystem::path& target) {
  Assimp::Exporter exporter;
  if (exporter.Export(&scene, "glb2", target.string()) != AI_SUCCESS) {
    throw ModelError(target.string() + " cannot be written: " + exporter.GetErrorString());
  }
}

/** Runs a use of a foreign file in a process of its own. @throws ModelError  naming the file. */
std::string run_with(const std::filesystem::path& file, const std::function<std::string()>& use) {
  try {
    return run_limited(use, ProcessLimits());
  } catch (const ModelError& error) {
    throw ModelError(file.string() + ": " + error.what());
  }
}

}  // namespace

std::vector<Eigen::Vector3d> read_mesh_points(const std::filesystem::path& file,
                                              const Eigen::Vector3d& scale) {
  const std::string bytes = run_with(file, [&] {
    Assimp::Importer importer;
    const aiScene& scene = read_scene(importer, file, scale);
    std::string text;
    for (unsigned i = 0; i < scene.mNumMeshes; ++i) {
      const aiMesh& mesh = *scene.mMeshes[i];
      for (unsigned k = 0; k < mesh.mNumVertices; ++k) {
        const aiVector3D& corner = mesh.mVertices[k];
        const std::array<double, 3> point = {corner.x, corner.y, corner.z};
        text.append(reinterpret_cast<const char*>(point.data()), sizeof point);
      }
    }
    return text;
  });
  std::vector<Eigen::Vector3d> points(bytes.size() / sizeof(Eigen::Vector3d));
  if (!points.empty()) std::memcpy(points.front().data(), bytes.data(), bytes.size());
  return points;
}

void convert_mesh(const std::filesystem::path& source, const Eigen::Vector3d& scale,
                  const std::optional<Color>& color, const std::filesystem::path& target,
                  double error) {
  run_with(source, [&] {
    Assimp::Importer importer;
    read_scene(importer, source, scale);
    const std::unique_ptr<aiScene> scene(importer.GetOrphanedScene());
    for (unsigned i = 0; i < scene->mNumMeshes; ++i) simplify(*scene->mMeshes[i], error);
    for (unsigned i = 0; color && i < scene->mNumMaterials; ++i) {
      aiMaterial& material = *scene->mMaterials[i];
      if (material.GetName() == aiString(AI_DEFAULT_MATERIAL_NAME)) set_color(material, *color);
    }
    // With this flag the exporter gives each triangle corners of its own.
    scene->mFlags &= ~static_cast<unsigned>(AI_SCENE_FLAGS_NON_VERBOSE_FORMAT);
    write_scene(*scene, target);
    return std::string();
  });
}

void write_mesh(const Mesh& mesh, const Color& color, const std::filesystem::path& target) {
  // The destructor of a scene frees all that it has.
  aiScene scene;
  scene.mRootNode = new aiNode;
  scene.mRootNode->mNumMeshes = 1;
  scene.mRootNode->mMeshes = new unsigned[1]{0};
  scene.mNumMeshes = 1;
  using MeshPointer = aiMesh*;
  scene.mMeshes = new MeshPointer[1];
  scene.mMeshes[0] = new aiMesh;
  scene.mMeshes[0]->mPrimitiveTypes = aiPrimitiveType_TRIANGLE;
  fill(*scene.mMeshes[0], mesh);
  scene.mNumMaterials = 1;
  using MaterialPointer = aiMaterial*;
  scene.mMaterials = new MaterialPointer[1];
  scene.mMaterials[0] = new aiMaterial;
  set_color(*scene.mMaterials[0], color);
  write_scene(scene, target);
}

void limit_meshes(const std::set<std::filesystem::path>& files) {
  for (double error = 2 * kFinestError; error <= kCoarsestError; error *= 2) {
    uintmax_t bytes = 0;
    for (const std::filesystem::path& file : files) bytes += std::filesystem::file_size(file);
    if (bytes <= kMostBytes) return;
    for (const std::filesystem::path& file : files) {
      convert_mesh(file, Eigen::Vector3d::Ones(), std::nullopt, file, error);
    }
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
