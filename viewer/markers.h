#pragma once

#include <Eigen/Core>
#include <vector>

#include "rendering/scene.h"

namespace nao {
class SceneRenderer;
}

namespace nao::viewer {

/** Adds markings to a scene. All positions are in the world, m. */
class Markers {
 public:
  explicit Markers(SceneRenderer& renderer);

  void add_arrow(Scene& scene, const Eigen::Vector3d& from, const Eigen::Vector3d& tip,
                 const Color& color) const;
  void add_sphere(Scene& scene, const Eigen::Vector3d& center, double radius,
                  const Color& color) const;
  /** Horizontal. */
  void add_disc(Scene& scene, const Eigen::Vector3d& center, double radius,
                const Color& color) const;
  /** Convex polygon with an opaque outline; nothing is added if a corner is not finite. */
  void add_polygon(Scene& scene, const std::vector<Eigen::Vector3d>& corners,
                   const Color& color) const;

 private:
  MeshId arrow_;
  MeshId sphere_;
};

}  // namespace nao::viewer
