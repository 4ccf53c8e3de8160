#pragma once

#include <memory>
#include <vector>

#include "rendering/gl_objects.h"
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

  /** The level of detail that suffices for an instance in this view. */
  const gl::MeshBuffer& buffer(const MeshInstance& instance, const RenderView& view) const;

  MeshStore& meshes_;
  const DepthProgram& depth_;
  LitProgram solid_;
  LitProgram ball_;
  MeshId ball_mesh_;
  std::vector<Goal> goals_;
  // Of the image that is being drawn.
  std::vector<MeshInstance> opaque_;
  std::vector<MeshInstance> translucent_;
  MeshInstance ball_instance_;
  bool is_ball_visible_ = false;
};

}  // namespace nao
