#pragma once

#include <memory>
#include <vector>

#include "rendering/gl_objects.h"
#include "rendering/mesh.h"
#include "rendering/scene.h"

namespace nao {

/** Meshes in graphics memory, each in several levels of detail. */
class MeshStore {
 public:
  MeshId add(const Mesh& mesh);

  /** The level with the fewest triangles that may be drawn for an instance.
   * @param most_error  Largest distance between the surfaces of the level and of the mesh, m. */
  const gl::MeshBuffer& buffer(const MeshInstance& instance, float most_error) const;
  /** The same without colors, for shadows: fewer triangles. */
  const gl::MeshBuffer& shape(const MeshInstance& instance, float most_error) const;

  /** Sphere in the world that encloses a mesh instance. */
  BoundingSphere sphere_in_world(const MeshInstance& instance) const;

 private:
  struct Level {
    Level(float most_error, const Mesh& mesh) : error(most_error), buffer(mesh) {}
    /** Largest distance from the surface of the mesh, m. */
    float error;
    gl::MeshBuffer buffer;
  };
  /** From fine to coarse; the first is the mesh itself. */
  using Levels = std::vector<std::unique_ptr<Level>>;
  struct Entry {
    Levels levels;
    Levels shapes;
    BoundingSphere sphere;
  };

  static Levels make_levels(const Mesh& mesh, float radius, float coarsest, size_t fewest,
                            Mesh (*simplify)(const Mesh&, float));

  std::vector<Entry> entries_;
};

}  // namespace nao
