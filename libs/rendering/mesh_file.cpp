#include "rendering/mesh_file.h"

#include <assimp/material.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <assimp/Importer.hpp>
#include <cmath>

#include "common/error.h"

namespace nao {
namespace {

// The material's base color (glTF), otherwise the diffuse one; white without either.
Color base_color(const aiMaterial& material) {
  aiColor4D color(1, 1, 1, 1);
  if (material.Get(AI_MATKEY_BASE_COLOR, color) != AI_SUCCESS) {
    material.Get(AI_MATKEY_COLOR_DIFFUSE, color);
  }
  return {color.r, color.g, color.b, color.a};
}

bool is_finite(const aiVector3D& vector) {
  return std::isfinite(vector.x) && std::isfinite(vector.y) && std::isfinite(vector.z);
}

void append_part(Mesh& mesh, const aiMesh& part, const Color& color, const std::string& file) {
  const auto first = static_cast<uint32_t>(mesh.vertices.size());
  const auto encoded_color = encode_color(color);
  for (unsigned i = 0; i < part.mNumVertices; ++i) {
    const aiVector3D& position = part.mVertices[i];
    const aiVector3D& normal = part.mNormals[i];
    if (!is_finite(position))
      throw ModelError("mesh " + file + " has a vertex with a non-finite coordinate");
    Vertex vertex;
    vertex.position = {position.x, position.y, position.z};
    // Degenerate triangles have no normal: they keep the default one.
    if (is_finite(normal)) vertex.normal = {normal.x, normal.y, normal.z};
    vertex.encoded_color = encoded_color;
    mesh.vertices.push_back(vertex);
  }
  for (unsigned i = 0; i < part.mNumFaces; ++i) {
    const aiFace& face = part.mFaces[i];
    if (face.mNumIndices != 3) continue;  // points and lines
    for (unsigned corner = 0; corner < 3; ++corner) {
      mesh.indices.push_back(first + face.mIndices[corner]);
    }
  }
}

}  // namespace

Mesh load_mesh(const std::filesystem::path& file) {
  if (!std::filesystem::exists(file)) throw ModelError("mesh " + file.string() + " does not exist");
  Assimp::Importer importer;
  // PreTransformVertices applies the transforms of the file's node tree, so that all parts are in
  // the mesh's own frame.
  const aiScene* scene = importer.ReadFile(
      file.string(), aiProcess_Triangulate | aiProcess_GenSmoothNormals |
                         aiProcess_PreTransformVertices | aiProcess_JoinIdenticalVertices |
                         aiProcess_ImproveCacheLocality | aiProcess_SortByPType);
  if (scene == nullptr) {
    throw ModelError("mesh " + file.string() + " cannot be read: " + importer.GetErrorString());
  }
  Mesh mesh;
  for (unsigned i = 0; i < scene->mNumMeshes; ++i) {
    const aiMesh& part = *scene->mMeshes[i];
    if (!part.HasNormals()) continue;  // only points and lines have none
    append_part(mesh, part, base_color(*scene->mMaterials[part.mMaterialIndex]), file.string());
  }
  if (mesh.indices.empty()) throw ModelError("mesh " + file.string() + " has no triangles");
  return mesh;
}

}  // namespace nao
