#pragma once

#include <optional>
#include <vector>

#include "rendering/gl_objects.h"
#include "rendering/pixel_box.h"
#include "rendering/render_statistics.h"
#include "rendering/render_view.h"
#include "rendering/shadow_pass.h"
#include "robot_model/scene_file.h"

namespace nao {

/** Draws the ground, as a soccer field or as a tiled floor, and the sky. */
class GroundPass {
 public:
  /** @param reach  Half the side of the ground's square, m. */
  explicit GroundPass(float reach);

  /** Replaces the field; without one the ground is a floor. */
  void set_surroundings(const SceneFile& scene) { field_dimensions_ = scene.field; }

  void draw_ground(const RenderView& view, const ShadowPass& shadows, RenderStatistics& statistics);
  /** Draws the background of all pixels that nothing else covers. */
  void draw_sky(const RenderView& view, RenderStatistics& statistics);

 private:
  void draw_boxes(const gl::ShaderProgram& program, const std::vector<PixelBox>& boxes,
                  const RenderView& view, const ShadowPass& shadows, RenderStatistics& statistics);

  float reach_;
  std::optional<FieldDimensions> field_dimensions_;
  gl::ShaderProgram field_;
  gl::ShaderProgram floor_;
  gl::ShaderProgram shadowed_field_;
  gl::ShaderProgram shadowed_floor_;
  gl::ShaderProgram sky_;
  gl::EmptyVertexArray vertices_;
};

}  // namespace nao
