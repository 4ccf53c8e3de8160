#pragma once

#include <vector>

#include "rendering/gl_objects.h"
#include "rendering/render_statistics.h"
#include "rendering/render_view.h"
#include "rendering/scene.h"
#include "robot_model/scene_file.h"

namespace nao {

/** Draws flat and thin things over the bodies: goal nets, and the lines and triangles of a scene.
 * Blending must be enabled, and writing of depth and culling of back faces disabled. */
class MarkingPass {
 public:
  MarkingPass();

  /** Replaces the goal nets. */
  void set_surroundings(const SceneFile& scene);

  void draw_nets(const RenderView& view, RenderStatistics& statistics);
  void draw_markings(const Scene& scene, const RenderView& view, RenderStatistics& statistics);

 private:
  gl::ShaderProgram net_;
  gl::ShaderProgram plain_;
  gl::StreamBuffer stream_;
  std::vector<gl::StreamBuffer::Vertex> net_vertices_;
};

}  // namespace nao
