#include "rendering/mesh_store.h"

namespace nao {
namespace {

/** Errors for which a mesh is simplified, as fractions of its radius: from the first, each by a
 * factor more than the one before it, up to the last. Chosen: the first saves a sixth of the
 * triangles of the NAO's meshes, after the last a tenth of them are left. */
constexpr float kFinestError = 1.0f / 256;
constexpr float kCoarsestError = 1.0f / 10;
constexpr float kErrorRatio = 1.6f;
/** The last error of shapes. Chosen: an error of 12 mm (shadow_pass.h) is a quarter of the radius
 * of the NAO's small links. */
constexpr float kCoarsestShape = 1.0f / 3;
/** A level is kept if it has at most this fraction of the triangles of the one before it. Chosen:
 * fewer savings do not pay for its memory. */
constexpr double kMostTriangles = 0.9;
/** Least number of triangles of meshes, and of shapes, that are simplified. */
constexpr size_t kFewTriangles = 48;
constexpr size_t kFewShapeTriangles = 12;

/** The coarsest level whose error, scaled, is at most this, m. */
template <class Levels>
const gl::MeshBuffer& coarsest(const Levels& levels, const MeshInstance& instance,
                               float most_error) {
  const float scale = instance.scale.cwiseAbs().maxCoeff();
  size_t level = 0;
  while (level + 1 < levels.size() && levels[level + 1]->error * scale <= most_error) ++level;
  return levels[level]->buffer;
}

}  // namespace

MeshStore::Levels MeshStore::make_levels(const Mesh& mesh, float radius, float coarsest,
                                         size_t fewest, Mesh (*simplify)(const Mesh&, float)) {
  Levels levels;
  levels.push_back(std::make_unique<Level>(0.0f, mesh));
  size_t num_indices = mesh.indices.size();
  for (float fraction = kFinestError; fraction <= coarsest; fraction *= kErrorRatio) {
    if (num_indices < 3 * fewest) break;
    const Mesh coarse = simplify(mesh, fraction * radius);
    if (coarse.indices.empty()) break;
    if (static_cast<double>(coarse.indices.size()) >
        kMostTriangles * static_cast<double>(num_indices)) {
      continue;
    }
    num_indices = coarse.indices.size();
    levels.push_back(std::make_unique<Level>(largest_distance(mesh, coarse), coarse));
  }
  return levels;
}

MeshId MeshStore::add(const Mesh& mesh) {
  Entry& entry = entries_.emplace_back();
  entry.sphere = bounding_sphere(mesh);
  const float radius = entry.sphere.radius;
  entry.levels = make_levels(mesh, radius, kCoarsestError, kFewTriangles, simplified);
  entry.shapes = make_levels(mesh, radius, kCoarsestShape, kFewShapeTriangles, simplified_shape);
  return static_cast<MeshId>(entries_.size()) - 1;
}

const gl::MeshBuffer& MeshStore::buffer(const MeshInstance& instance, float most_error) const {
  return coarsest(entries_[instance.mesh].levels, instance, most_error);
}

const gl::MeshBuffer& MeshStore::shape(const MeshInstance& instance, float most_error) const {
  return coarsest(entries_[instance.mesh].shapes, instance, most_error);
}

// A scale that differs by axis makes an ellipsoid of the sphere; its largest half axis bounds it.
BoundingSphere MeshStore::sphere_in_world(const MeshInstance& instance) const {
  const BoundingSphere& sphere = entries_[instance.mesh].sphere;
  return {instance.pose_in_world * sphere.center.cwiseProduct(instance.scale),
          sphere.radius * instance.scale.cwiseAbs().maxCoeff()};
}

}  // namespace nao
