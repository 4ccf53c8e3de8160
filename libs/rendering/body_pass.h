#pragma once

#include <memory>
#include <vector>

#include "rendering/gl_objects.h"
#include "rendering/mesh_draws.h"
#include "rendering/mesh_programs.h"
#include "rendering/mesh_store.h"
#include "rendering/render_statistics.h"
#include "rendering/render_view.h"
#include "rendering/scene.h"
#include "rendering/shadow_pass.h"
#include "robot_model/scene_file.h"

namespace nao {

/** Draws the bodies of a scene: mesh instances, the ball, and the frames of the goals. */
class BodyPass {
 public:
  /** @param meshes, depth  Must outlive this. @param with_shadow  Whether bodies receive shadows.
   */
  BodyPass(MeshStore& meshes, const DepthProgram& depth, bool with_shadow);

  /** Replaces the goals. */
  void set_surroundings(const SceneFile& scene);

  /** Selects the bodies that are in view, and gives those that cast shadows to the shadow pass. */
  void select(const Scene& scene, const RenderView& view, ShadowPass& shadows);

  /** Draws what select() selected. */
  void draw_opaque(const RenderView& view, const ShadowPass& shadows, RenderStatistics& statistics);

  /** Draws the translucent bodies that select() selected: of each pixel only the nearest surface of
   * them, not the surfaces inside. Blending must be enabled. */
  void draw_translucent(const RenderView& view, const ShadowPass& shadows,
                        RenderStatistics& statistics);

 private:
  struct Goal {
    std::unique_ptr<gl::MeshBuffer> buffer;
    BoundingSphere sphere;
  };

  /** Distance from the eye to the body's sphere, m; 0 inside. */
  float distance(const MeshInstance& instance, const RenderView& view) const;
  /** Adds an instance that is in view, in the level of detail that suffices. */
  void add(const MeshInstance& instance, const RenderView& view, MeshDraws& draws) const;

  MeshStore& meshes_;
  const DepthProgram& depth_;
  LitProgram near_program_;
  LitProgram far_program_;
  LitProgram ball_program_;
  MeshId ball_mesh_;
  std::vector<Goal> goals_;
  // Draws of the current image.
  /** Opaque bodies. */
  MeshDraws near_;
  MeshDraws far_;
  MeshDraws translucent_;
  MeshDraws ball_;
};

}  // namespace nao
