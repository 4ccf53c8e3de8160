#pragma once

#include <optional>
#include <string>
#include <vector>

#include "rendering/field_patches.h"
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
  void set_surroundings(const SceneFile& scene);

  void draw_ground(const RenderView& view, const ShadowPass& shadows, RenderStatistics& statistics);
  /** Draws the background of all pixels that nothing else covers. */
  void draw_sky(const RenderView& view, RenderStatistics& statistics);

 private:
  using Vertices = std::vector<gl::StreamBuffer::Vertex>;

  /** A shader for what may be in shadow, and one for all else: shadow lookups are expensive. */
  struct Programs {
    gl::ShaderProgram shadowed;
    gl::ShaderProgram lit;
  };

  static Programs compile_both(std::vector<std::string> parts,
                               const std::vector<std::string>& defines = {});

  void draw_patches(const RenderView& view, const ShadowPass& shadows,
                    RenderStatistics& statistics);
  void draw(const Programs& programs, const std::vector<GroundPatch>& patches,
            const RenderView& view, const ShadowPass& shadows, RenderStatistics& statistics);
  void use(const gl::ShaderProgram& program, const RenderView& view,
           const ShadowPass& shadows) const;

  /** Half the side of the ground's square, m. */
  float reach_;
  std::vector<GroundPatch> ground_;
  std::optional<FieldDimensions> field_dimensions_;
  FieldPatches patches_;
  /** Patches that the carpet's program draws. */
  bool is_hall_ = false;
  /** Pixels of the image that is being drawn in which the ground may be in shadow. */
  std::vector<PixelBox> shadowed_;
  Programs field_;
  Programs worn_field_;
  Programs line_;
  Programs carpet_;
  Programs floor_;
  gl::ShaderProgram sky_;
  gl::StreamBuffer buffer_;
  gl::EmptyVertexArray sky_vertices_;
};

}  // namespace nao
