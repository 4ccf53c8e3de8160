#pragma once

#include <memory>
#include <string>
#include <vector>

#include "rendering/pinhole_camera.h"
#include "rendering/scene.h"
#include "robot_model/scene_file.h"

namespace nao {

struct RendererOptions {
  /** Side of the shadow map, texels; 0 draws no shadows. */
  int shadow_size = 320;
  /** How far from the origin the ground reaches, m. Haze hides its end. */
  float ground_reach = 60;
};

/** Part of a picture, pixels from its lower left corner; right and top just outside. */
struct PixelBox {
  int left = 0;
  int bottom = 0;
  int right = 0;
  int top = 0;

  bool is_empty() const { return left >= right || bottom >= top; }
};

/** What drawing one picture took. */
struct RenderStatistics {
  int num_draws = 0;
  int num_triangles = 0;
};

/** Draws the robot's world with OpenGL 3.3, into whichever context is current.
 *
 * It opens no context and keeps nothing outside itself: a window and a camera without a screen use
 * it alike. Made, used and destroyed while the same context is current. It sets every OpenGL state
 * that it depends on, and leaves them as it used them. */
class SceneRenderer {
 public:
  /** @throws Error  if the context is older than 3.3 or a shader is refused. */
  explicit SceneRenderer(const RendererOptions& options = {});
  ~SceneRenderer();
  SceneRenderer(const SceneRenderer&) = delete;
  SceneRenderer& operator=(const SceneRenderer&) = delete;

  /** Keeps a mesh for drawing it as often as wished. */
  MeshId add_mesh(const Mesh& mesh);

  /** Ground, lines and goals from now on. */
  void set_surroundings(const SceneFile& scene);

  /** Draws one picture.
   * @param pose_camera_in_world  Camera axes: x along the view, y left, z up.
   * @param framebuffer  OpenGL's number of where to draw; its lower left corner is used.
   * @param covered  Parts that something else will cover: they are left as they are, and cost
   * nothing. */
  RenderStatistics render(const Scene& scene, const PinholeCamera& camera,
                          const Eigen::Isometry3d& pose_camera_in_world, unsigned framebuffer,
                          const std::vector<PixelBox>& covered = {});

  /** Who draws, in the driver's words: "llvmpipe (LLVM 15.0.6, 256 bits)". */
  static std::string driver();

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace nao
