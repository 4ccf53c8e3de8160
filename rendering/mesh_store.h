#pragma once

#include <memory>
#include <vector>

#include "rendering/gl_objects.h"
#include "rendering/mesh.h"
#include "rendering/scene.h"

namespace nao {

/** Meshes in graphics memory, each also in a simplified form for the shadow map. */
class MeshStore {
 public:
  MeshId add(const Mesh& mesh);

  const gl::MeshBuffer& buffer(MeshId mesh) const { return *entries_[mesh].buffer; }
  /** The simplified mesh. */
  const gl::MeshBuffer& shadow_caster(MeshId mesh) const { return *entries_[mesh].shadow_caster; }

  /** Sphere in the world that encloses a mesh instance. */
  BoundingSphere sphere_in_world(const MeshInstance& instance) const;

 private:
  struct Entry {
    std::unique_ptr<gl::MeshBuffer> buffer;
    std::unique_ptr<gl::MeshBuffer> shadow_caster;
    BoundingSphere sphere;
  };

  std::vector<Entry> entries_;
};

}  // namespace nao
