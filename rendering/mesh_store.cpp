#include "rendering/mesh_store.h"

namespace nao {
namespace {

/** Errors for which a mesh is simplified, as fractions of its radius: from the first, each by a
 * factor more than the one before it, up to the last. Chosen: the first saves a sixth of the
 * triangles of the NAO's meshes, after the last a tenth of them are left. */
constexpr float kFinestError = 1.0f / 256;
constexpr float kCoarsestError = 1.0f / 10;
constexpr float kErrorRatio = 1.6f;
/** A level is kept if it has at most this fraction of the triangles of the one before it. Chosen:
 * fewer savings do not pay for its memory. */
constexpr double kMostTriangles = 0.9;
/** Meshes with fewer triangles are left as they are. */
constexpr size_t kFewTriangles = 48;

}  // namespace

MeshId MeshStore::add(const Mesh& mesh) {
  Entry& entry = entries_.emplace_back();
  entry.sphere = bounding_sphere(mesh);
  entry.levels.push_back(std::make_unique<Level>(0.0f, mesh));
  size_t num_indices = mesh.indices.size();
  for (float fraction = kFinestError; fraction <= kCoarsestError; fraction *= kErrorRatio) {
    if (num_indices < 3 * kFewTriangles) break;
    const Mesh coarse = simplified(mesh, fraction * entry.sphere.radius);
    if (coarse.indices.empty()) break;
    if (static_cast<double>(coarse.indices.size()) >
        kMostTriangles * static_cast<double>(num_indices)) {
      continue;
    }
    num_indices = coarse.indices.size();
    entry.levels.push_back(std::make_unique<Level>(largest_distance(mesh, coarse), coarse));
  }
  return static_cast<MeshId>(entries_.size()) - 1;
}

const gl::MeshBuffer& MeshStore::buffer(const MeshInstance& instance, float most_error) const {
  const auto& levels = entries_[instance.mesh].levels;
  const float scale = instance.scale.cwiseAbs().maxCoeff();
  size_t coarsest = 0;
  while (coarsest + 1 < levels.size() && levels[coarsest + 1]->error * scale <= most_error) {
    ++coarsest;
  }
  return levels[coarsest]->buffer;
}

// A scale that differs by axis makes an ellipsoid of the sphere; its largest half axis bounds it.
BoundingSphere MeshStore::sphere_in_world(const MeshInstance& instance) const {
  const BoundingSphere& sphere = entries_[instance.mesh].sphere;
  return {instance.pose_in_world * sphere.center.cwiseProduct(instance.scale),
          sphere.radius * instance.scale.cwiseAbs().maxCoeff()};
}

}  // namespace nao
