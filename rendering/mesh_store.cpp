#include "rendering/mesh_store.h"

namespace nao {
namespace {

/** Grid cell of simplified meshes, m. Chosen: about seven texels of the head camera's shadow map
 * when it covers one robot (0.6 m over 320 texels). */
constexpr float kShadowCell = 0.014f;

}  // namespace

// Each mesh is kept twice: as it is, and simplified for the shadow map.
MeshId MeshStore::add(const Mesh& mesh) {
  entries_.push_back({std::make_unique<gl::MeshBuffer>(mesh),
                      std::make_unique<gl::MeshBuffer>(simplified(mesh, kShadowCell)),
                      bounding_sphere(mesh)});
  return static_cast<MeshId>(entries_.size()) - 1;
}

// A scale that differs by axis makes an ellipsoid of the sphere; its largest half axis bounds it.
BoundingSphere MeshStore::sphere_in_world(const MeshInstance& instance) const {
  const BoundingSphere& sphere = entries_[instance.mesh].sphere;
  return {instance.pose_in_world * sphere.center.cwiseProduct(instance.scale),
          sphere.radius * instance.scale.cwiseAbs().maxCoeff()};
}

}  // namespace nao
