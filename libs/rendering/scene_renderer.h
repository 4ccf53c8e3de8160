#pragma once

#include <memory>
#include <string>
#include <vector>

#include "rendering/pinhole_camera.h"
#include "rendering/pixel_box.h"
#include "rendering/render_statistics.h"
#include "rendering/scene.h"
#include "rendering/scene_appearance.h"
#include "robot_model/scene_file.h"

namespace nao {

struct RendererOptions {
  /** Greatest side of the shadow map, texels; 0 draws no shadows. */
  int shadow_size = 320;
  /** Half the side of the ground's square, m. Haze hides its edge. */
  float ground_reach = 60;
};

/** Draws the robot's world with OpenGL 3.3, into the current context.
 *
 * It creates no context and has no global state, so a window and an offscreen camera use it alike.
 * Create, use and destroy it while the same context is current. It sets every OpenGL state that it
 * depends on, and does not restore the previous state. */
class SceneRenderer {
 public:
  /** @throws Error  if the context is older than 3.3 or a shader does not compile. */
  explicit SceneRenderer(const RendererOptions& options = {});
  ~SceneRenderer();
  SceneRenderer(const SceneRenderer&) = delete;
  SceneRenderer& operator=(const SceneRenderer&) = delete;

  /** Stores a mesh; scenes may contain any number of instances of it. */
  MeshId add_mesh(const Mesh& mesh);

  /** Sets the ground, its lines and the goals of the following images. */
  void set_surroundings(const SceneFile& scene);

  /** Sets light and materials of the following images. */
  void set_appearance(const SceneAppearance& appearance) { appearance_ = appearance; }

  /** Draws one image.
   * @param pose_camera_in_world  Camera axes: x along the view, y left, z up.
   * @param framebuffer  OpenGL's number of the target; its lower left corner is used.
   * @param covered  Parts that something else will cover: they are not drawn, which saves time. */
  RenderStatistics render(const Scene& scene, const PinholeCamera& camera,
                          const Eigen::Isometry3d& pose_camera_in_world, unsigned framebuffer,
                          const std::vector<PixelBox>& covered = {});

  /** Name of the OpenGL driver, such as "llvmpipe (LLVM 15.0.6, 256 bits)". */
  static std::string driver();

 private:
  class Passes;
  std::unique_ptr<Passes> passes_;
  SceneAppearance appearance_;
};

}  // namespace nao
