#include "rendering/ground_pass.h"

#include <algorithm>

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

/** Two triangles. */
void append(std::vector<gl::StreamBuffer::Vertex>& vertices, const Eigen::AlignedBox2f& box) {
  using Box = Eigen::AlignedBox2f;
  for (const auto corner : {Box::BottomLeft, Box::BottomRight, Box::TopRight, Box::BottomLeft,
                            Box::TopRight, Box::TopLeft}) {
    const Eigen::Vector2f place = box.corner(corner);
    vertices.push_back({{place.x(), place.y(), 0}, Eigen::Vector4f::Zero()});
  }
}

/** Depth offset of the carpet without lines towards the eye, so that the whole ground, which is
 * drawn after it, does not cover it again (glPolygonOffset's units). Chosen: more than the rounding
 * of depths, less than a millimeter at the near plane. */
constexpr float kCarpetOffset = -8;

/** Lowest row of the image that may show sky: below it every ray meets the ground. */
// The ground ends at least `reach` less the eye's distance from the origin away. A ray is above its
// end if its height exceeds a negative bound; both are linear along the image's left and right
// edges, where the lowest such ray is if the camera is upright.
int lowest_sky_row(const Eigen::Matrix4f& world_from_clip, const RenderView& view, float reach) {
  const float end = reach - view.eye.head<2>().norm();
  if (end <= 0 || view.eye.z() <= 0) return 0;
  float lowest = static_cast<float>(view.height);
  for (const float x : {-1.0f, 1.0f}) {
    const Eigen::Vector3f down = (world_from_clip * Eigen::Vector4f(x, -1, 1, 1)).head<3>();
    const Eigen::Vector3f up = (world_from_clip * Eigen::Vector4f(x, 1, 1, 1)).head<3>();
    const float bound = -view.eye.z() / end * std::max(up.norm(), down.norm());
    if (up.z() <= down.z()) return 0;
    const float fraction = (bound - down.z()) / (up.z() - down.z());
    lowest = std::min(lowest, std::clamp(fraction, 0.0f, 1.0f) * static_cast<float>(view.height));
  }
  return static_cast<int>(lowest);
}

}  // namespace

GroundPass::GroundPass(float reach)
    : reach_(reach),
      field_{compile("shadowed field", shaders::field(true, false)),
             compile("field", shaders::field(false, false))},
      worn_field_{compile("shadowed worn field", shaders::field(true, true)),
                  compile("worn field", shaders::field(false, true))},
      carpet_{compile("shadowed carpet", shaders::carpet(true, false)),
              compile("carpet", shaders::carpet(false, false))},
      worn_carpet_{compile("shadowed worn carpet", shaders::carpet(true, true)),
                   compile("worn carpet", shaders::carpet(false, true))},
      floor_{compile("shadowed floor", shaders::floor(true)),
             compile("floor", shaders::floor(false))},
      sky_(compile("sky", shaders::sky())) {
  const Eigen::Vector2f corner = Eigen::Vector2f::Constant(reach);
  append(ground_, {-corner, corner});
}

void GroundPass::set_surroundings(const SceneFile& scene) {
  field_dimensions_ = scene.field;
  cells_ = scene.field ? CarpetCells(*scene.field) : CarpetCells();
}

// What is drawn first covers what follows in the same place, since the depth must be less.
void GroundPass::draw_ground(const RenderView& view, const ShadowPass& shadows,
                             RenderStatistics& statistics) {
  shadowed_ = shadows.shadowed_pixels(view);
  glDepthFunc(GL_LESS);
  if (field_dimensions_) {
    const bool is_worn = view.appearance.carpet_texture > 0 || view.appearance.line_wear > 0;
    Vertices carpet;
    for (const Eigen::AlignedBox2f& box : cells_.without_lines(view)) append(carpet, box);
    glEnable(GL_POLYGON_OFFSET_FILL);
    glPolygonOffset(0, kCarpetOffset);
    draw(is_worn ? worn_carpet_ : carpet_, carpet, view, shadows, statistics);
    glDisable(GL_POLYGON_OFFSET_FILL);
    draw(is_worn ? worn_field_ : field_, ground_, view, shadows, statistics);
  } else {
    draw(floor_, ground_, view, shadows, statistics);
  }
  glDepthFunc(GL_LEQUAL);
}

void GroundPass::draw(const Programs& programs, const Vertices& vertices, const RenderView& view,
                      const ShadowPass& shadows, RenderStatistics& statistics) {
  if (!shadowed_.empty()) {
    use(programs.shadowed, view, shadows);
    glEnable(GL_SCISSOR_TEST);
    for (const PixelBox& box : shadowed_) {
      glScissor(box.left, box.bottom, box.right - box.left, box.top - box.bottom);
      buffer_.draw_triangles(vertices);
      ++statistics.num_draws;
    }
    glDisable(GL_SCISSOR_TEST);
  }
  use(programs.lit, view, shadows);
  buffer_.draw_triangles(vertices);
  ++statistics.num_draws;
}

void GroundPass::use(const gl::ShaderProgram& program, const RenderView& view,
                     const ShadowPass& shadows) const {
  use_lit(program, view, shadows);
  if (!field_dimensions_) return;
  set_field(program, *field_dimensions_);
  program.set("carpet_color", view.appearance.carpet);
  program.set("line_color", view.appearance.line);
  program.set("line_wear", view.appearance.line_wear);
  program.set("carpet_texture", view.appearance.carpet_texture);
}

void GroundPass::draw_sky(const RenderView& view, RenderStatistics& statistics) {
  // The projection with the eye at the origin: its inverse gives the direction through each pixel.
  Eigen::Matrix4f eye_at_origin = Eigen::Matrix4f::Identity();
  // clip_from_world * T(eye) has no translation of the eye left: directions only.
  eye_at_origin.topRightCorner<3, 1>() = view.eye;
  const Eigen::Matrix4f world_from_clip = (view.clip_from_world * eye_at_origin).inverse();
  sky_.use();
  sky_.set("world_from_clip", world_from_clip);
  glEnable(GL_SCISSOR_TEST);
  const int bottom = lowest_sky_row(world_from_clip, view, reach_);
  glScissor(0, bottom, view.width, view.height - bottom);
  sky_vertices_.draw_triangles(3);
  glDisable(GL_SCISSOR_TEST);
  ++statistics.num_draws;
}

}  // namespace nao
