#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "rendering/gl_objects.h"
#include "rendering/mesh_draws.h"
#include "rendering/mesh_programs.h"
#include "rendering/mesh_store.h"
#include "rendering/pixel_box.h"
#include "rendering/render_statistics.h"
#include "rendering/render_view.h"
#include "rendering/scene.h"

namespace nao {

/** Largest error of a shadow caster's surface, m. Chosen: about two texels of the head camera's
 * shadow map when it covers one robot. */
inline constexpr float kCasterError = 0.012f;

/** Draws the shadow map: the depth of all shadow casters as seen from the light (Williams, "Casting
 * curved shadows on curved surfaces", SIGGRAPH 1978). The map covers the casters only. */
class ShadowPass {
 public:
  /** @param size  Greatest side of the shadow map, texels; 0 turns shadows off.
   * @param meshes, depth  Must outlive this. */
  ShadowPass(int size, const MeshStore& meshes, const DepthProgram& depth);

  /** Starts the next image. @param light  Unit vector towards the light, in the world. */
  void clear(const Eigen::Vector3f& light);

  /** Adds a body, unless neither it nor its shadow on the ground can be visible. */
  void add_caster(const MeshInstance& instance, const RenderView& view);

  /** @return false only if no caster shadows any part of the sphere, m, in the world. */
  bool may_shadow(const BoundingSphere& sphere) const;

  /** Draws the casters into the shadow map; leaves its framebuffer bound. */
  void draw(RenderStatistics& statistics);

  /** Sets the shadow map of the program in use. */
  void set_uniforms(const gl::ShaderProgram& program) const;

  /** Boxes of the pixels in which the ground may be in shadow; none is empty, and no two overlap.
   */
  std::vector<PixelBox> shadowed_pixels(const RenderView& view) const;

 private:
  const MeshStore& meshes_;
  const DepthProgram& depth_;
  std::optional<gl::ShadowMap> map_;
  Eigen::Vector3f light_ = Eigen::Vector3f::UnitZ();
  std::vector<MeshInstance> casters_;
  MeshDraws draws_;
  /** Box of the casters in the axes of the light, m. */
  Eigen::AlignedBox3f casters_box_;
  /** From the world to the map's texture coordinates, 0 to 1, and depth. */
  Eigen::Matrix4f shadow_from_world_ = Eigen::Matrix4f::Identity();
};

}  // namespace nao
