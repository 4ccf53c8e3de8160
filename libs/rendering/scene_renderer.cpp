#include "rendering/scene_renderer.h"

#include "common/error.h"
#include "rendering/body_pass.h"
#include "rendering/gl.h"
#include "rendering/ground_pass.h"
#include "rendering/marking_pass.h"
#include "rendering/mesh_programs.h"
#include "rendering/mesh_store.h"
#include "rendering/render_view.h"
#include "rendering/shadow_pass.h"

namespace nao {
namespace {

/** Sets every OpenGL state that the passes depend on. */
void reset_state() {
  glDisable(GL_BLEND);
  glDisable(GL_SCISSOR_TEST);
  glDisable(GL_STENCIL_TEST);
  glDisable(GL_POLYGON_OFFSET_FILL);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LEQUAL);
  glDepthMask(GL_TRUE);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glEnable(GL_CULL_FACE);
  glCullFace(GL_BACK);
  glFrontFace(GL_CCW);
  glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
  glActiveTexture(GL_TEXTURE0);
}

/** Sets the depth of the boxes to the least one, so that every fragment there fails the depth test
 * and is never shaded. */
void exclude(const std::vector<PixelBox>& boxes) {
  glEnable(GL_SCISSOR_TEST);
  glClearDepth(0);
  for (const PixelBox& box : boxes) {
    if (box.is_empty()) continue;
    glScissor(box.left, box.bottom, box.right - box.left, box.top - box.bottom);
    glClear(GL_DEPTH_BUFFER_BIT);
  }
  glClearDepth(1);
  glDisable(GL_SCISSOR_TEST);
}

}  // namespace

/** The passes of one image, in the order in which they run. */
class SceneRenderer::Passes {
 public:
  explicit Passes(const RendererOptions& options)
      : shadows_(options.shadow_size, meshes_, depth_),
        bodies_(meshes_, depth_, options.shadow_size > 0),
        ground_(options.ground_reach) {}

  MeshId add_mesh(const Mesh& mesh) { return meshes_.add(mesh); }

  void set_surroundings(const SceneFile& scene) {
    bodies_.set_surroundings(scene);
    ground_.set_surroundings(scene);
    markings_.set_surroundings(scene);
  }

  RenderStatistics render(const Scene& scene, const RenderView& view, unsigned framebuffer,
                          const std::vector<PixelBox>& covered) {
    RenderStatistics statistics;
    bodies_.select(scene, view, shadows_);
    reset_state();
    shadows_.draw(statistics);

    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glViewport(0, 0, view.width, view.height);
    glClear(GL_DEPTH_BUFFER_BIT);  // not the color: the sky covers what nothing else does
    exclude(covered);
    // The background first, without the depth test, which costs more than the shading of what
    // bodies hide of it. No body reaches below the ground.
    if (covered.empty()) glDisable(GL_DEPTH_TEST);
    glDepthMask(GL_FALSE);
    ground_.draw_sky(view, statistics);
    ground_.draw_ground(view, shadows_, statistics);
    glDepthMask(GL_TRUE);
    glEnable(GL_DEPTH_TEST);
    bodies_.draw_opaque(view, shadows_, statistics);

    // Translucent things last, over what is behind them. Nets and markings do not write depth, so
    // that they do not hide each other.
    glEnable(GL_BLEND);
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    bodies_.draw_translucent(view, shadows_, statistics);
    glDepthMask(GL_FALSE);
    glDisable(GL_CULL_FACE);
    markings_.draw_nets(view, statistics);
    markings_.draw_markings(scene, view, statistics);
    glEnable(GL_CULL_FACE);
    glDepthMask(GL_TRUE);
    glDisable(GL_BLEND);
    // State is left as the viewer's own drawing expects it.
    glBindVertexArray(0);
    glUseProgram(0);
    return statistics;
  }

 private:
  MeshStore meshes_;
  DepthProgram depth_;
  ShadowPass shadows_;
  BodyPass bodies_;
  GroundPass ground_;
  MarkingPass markings_;
};

SceneRenderer::SceneRenderer(const RendererOptions& options) {
  int major = 0;
  int minor = 0;
  glGetIntegerv(GL_MAJOR_VERSION, &major);
  glGetIntegerv(GL_MINOR_VERSION, &minor);
  if (major * 10 + minor < 33) {
    throw Error("rendering needs OpenGL 3.3 or newer, the driver offers " + std::to_string(major) +
                "." + std::to_string(minor));
  }
  passes_ = std::make_unique<Passes>(options);
}

SceneRenderer::~SceneRenderer() = default;

MeshId SceneRenderer::add_mesh(const Mesh& mesh) {
  return passes_->add_mesh(mesh);
}

void SceneRenderer::set_surroundings(const SceneFile& scene) {
  passes_->set_surroundings(scene);
}

RenderStatistics SceneRenderer::render(const Scene& scene, const PinholeCamera& camera,
                                       const Eigen::Isometry3d& pose_camera_in_world,
                                       unsigned framebuffer, const std::vector<PixelBox>& covered) {
  return passes_->render(scene, RenderView(camera, pose_camera_in_world, appearance_), framebuffer,
                         covered);
}

std::string SceneRenderer::driver() {
  const auto* name = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  return name != nullptr ? name : "unknown";
}

}  // namespace nao
