#include "rendering/ground_pass.h"

#include "rendering/gl.h"
#include "rendering/mesh_programs.h"
#include "rendering/shaders.h"

namespace nao {
namespace {

void set_field(const gl::ShaderProgram& program, const FieldDimensions& field) {
  const auto pair = [](double x, double y) {
    return Eigen::Vector2f(static_cast<float>(x), static_cast<float>(y));
  };
  // Lengths are passed as the shader uses them: halves of what is symmetric about the center.
  const double strip = field.border_strip_width;
  program.set("half_field", pair(field.length / 2, field.width / 2));
  program.set("half_carpet", pair(field.length / 2 + strip, field.width / 2 + strip));
  program.set("half_line", static_cast<float>(field.line_width / 2));
  program.set("goal_area", pair(field.goal_area_length, field.goal_area_width / 2));
  program.set("penalty_area", pair(field.penalty_area_length, field.penalty_area_width / 2));
  program.set("penalty_mark",
              pair(field.length / 2 - field.penalty_mark_distance, field.penalty_mark_size / 2));
  program.set("center", pair(field.centre_circle_diameter / 2, field.centre_mark_length / 2));
}

}  // namespace

GroundPass::GroundPass(float reach)
    : reach_(reach),
      field_(compile("field", shaders::field(false))),
      floor_(compile("floor", shaders::floor(false))),
      shadowed_field_(compile("shadowed field", shaders::field(true))),
      shadowed_floor_(compile("shadowed floor", shaders::floor(true))),
      sky_(compile("sky", shaders::sky())) {}

void GroundPass::draw_ground(const RenderView& view, const ShadowPass& shadows,
                             RenderStatistics& statistics) {
  // Only the box that may hold shadows is drawn with shadow look-ups, since they are expensive; the
  // four strips around it are drawn without.
  const PixelBox all{0, 0, view.width, view.height};
  const PixelBox shadowed = shadows.shadowed_pixels(view);
  const bool is_field = field_dimensions_.has_value();
  const gl::ShaderProgram& lit = is_field ? field_ : floor_;
  const gl::ShaderProgram& with_shadow = is_field ? shadowed_field_ : shadowed_floor_;
  glEnable(GL_SCISSOR_TEST);
  if (shadowed.is_empty()) {
    draw_boxes(lit, {all}, view, shadows, statistics);
  } else {
    draw_boxes(with_shadow, {shadowed}, view, shadows, statistics);
    // Below and above over the whole width; left and right of it in between.
    draw_boxes(lit,
               {{all.left, all.bottom, all.right, shadowed.bottom},
                {all.left, shadowed.top, all.right, all.top},
                {all.left, shadowed.bottom, shadowed.left, shadowed.top},
                {shadowed.right, shadowed.bottom, all.right, shadowed.top}},
               view, shadows, statistics);
  }
  glDisable(GL_SCISSOR_TEST);
}

void GroundPass::draw_boxes(const gl::ShaderProgram& program, const std::vector<PixelBox>& boxes,
                            const RenderView& view, const ShadowPass& shadows,
                            RenderStatistics& statistics) {
  use_lit(program, view, shadows);
  program.set("reach", reach_);
  if (field_dimensions_) {
    set_field(program, *field_dimensions_);
    program.set("carpet_color", view.appearance.carpet);
    program.set("line_color", view.appearance.line);
    program.set("line_wear", view.appearance.line_wear);
    program.set("carpet_texture", view.appearance.carpet_texture);
  }
  for (const PixelBox& box : boxes) {
    if (box.is_empty()) continue;
    // The scissor box limits one large quadrilateral to these pixels.
    glScissor(box.left, box.bottom, box.right - box.left, box.top - box.bottom);
    vertices_.draw_triangles(6);
    ++statistics.num_draws;
  }
}

void GroundPass::draw_sky(const RenderView& view, RenderStatistics& statistics) {
  sky_.use();
  // The projection with the eye at the origin: its inverse gives the direction through each pixel.
  Eigen::Matrix4f eye_at_origin = Eigen::Matrix4f::Identity();
  // clip_from_world * T(eye) has no translation of the eye left: directions only.
  eye_at_origin.topRightCorner<3, 1>() = view.eye;
  sky_.set("world_from_clip", Eigen::Matrix4f((view.clip_from_world * eye_at_origin).inverse()));
  vertices_.draw_triangles(3);
  ++statistics.num_draws;
}

}  // namespace nao
