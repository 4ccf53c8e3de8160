#include "rendering/ground_pass.h"

#include <algorithm>

#include "rendering/gl.h"
#include "rendering/mesh_programs.h"

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
void append(std::vector<gl::StreamBuffer::Vertex>& vertices, const GroundPatch& patch) {
  using Box = Eigen::AlignedBox2f;
  const Eigen::Vector4f line(patch.normal.x(), patch.normal.y(), patch.middle,
                             patch.is_edge ? 1.0f : 0.0f);
  for (const auto corner : {Box::BottomLeft, Box::BottomRight, Box::TopRight, Box::BottomLeft,
                            Box::TopRight, Box::TopLeft}) {
    const Eigen::Vector2f place = patch.box.corner(corner);
    vertices.push_back({{place.x(), place.y(), 0}, line});
  }
}

/** Cells of the sky, over the image. Chosen: in a head camera's image its color is then at most 1.2
 * of 255 off, at any pitch from -35 to 30 degrees. */
constexpr int kSkyColumns = 4;
constexpr int kSkyRows = 3;

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

GroundPass::Programs GroundPass::compile_both(std::vector<std::string> parts,
                                              const std::vector<std::string>& defines) {
  parts.insert(parts.begin(), {"lighting", "haze"});
  std::vector<std::string> with_shadow = defines;
  with_shadow.emplace_back("WITH_SHADOW");
  return {compile(parts, with_shadow), compile(parts, defines)};
}

GroundPass::GroundPass(float reach)
    : reach_(reach),
      field_(compile_both({"ground", "carpet_color", "field"})),
      worn_field_(compile_both({"ground", "carpet_color", "field"}, {"WITH_WEAR"})),
      line_(compile_both({"carpet_color", "field_line"})),
      carpet_(compile_both({"carpet_color", "carpet"})),
      floor_(compile_both({"ground", "floor"})),
      sky_(compile({"sky"})) {
  const Eigen::Vector2f corner = Eigen::Vector2f::Constant(reach);
  ground_.emplace_back().box = {-corner, corner};
}

void GroundPass::set_surroundings(const SceneFile& scene) {
  field_dimensions_ = scene.field;
  patches_ = scene.field ? FieldPatches(*scene.field, reach_) : FieldPatches();
}

void GroundPass::draw_ground(const RenderView& view, const ShadowPass& shadows,
                             RenderStatistics& statistics) {
  shadowed_ = shadows.shadowed_pixels(view);
  const SceneAppearance& look = view.appearance;
  const bool is_varied = look.carpet_texture > 0 || look.line_wear > 0 || look.shade_depth > 0;
  if (!field_dimensions_) {
    draw(floor_, ground_, view, shadows, statistics);
  } else if (is_varied) {
    draw(worn_field_, ground_, view, shadows, statistics);
  } else {
    draw_patches(view, shadows, statistics);
  }
}

// What is drawn last covers what is in the same place.
void GroundPass::draw_patches(const RenderView& view, const ShadowPass& shadows,
                              RenderStatistics& statistics) {
  patches_.select(view);
  is_hall_ = true;
  draw(carpet_, patches_.hall(), view, shadows, statistics);
  is_hall_ = false;
  draw(carpet_, patches_.carpet(), view, shadows, statistics);
  draw(line_, patches_.lines(), view, shadows, statistics);
  draw(field_, patches_.mixed(), view, shadows, statistics);
}

void GroundPass::draw(const Programs& programs, const std::vector<GroundPatch>& patches,
                      const RenderView& view, const ShadowPass& shadows,
                      RenderStatistics& statistics) {
  Vertices vertices;
  for (const GroundPatch& patch : patches) append(vertices, patch);
  if (vertices.empty()) return;
  use(programs.lit, view, shadows);
  buffer_.draw_triangles(vertices);
  ++statistics.num_draws;
  glEnable(GL_SCISSOR_TEST);
  for (const PixelBox& box : shadowed_) {
    vertices.clear();
    for (const GroundPatch& patch : patches) {
      if (overlap(ground_pixels(patch.box, view), box)) append(vertices, patch);
    }
    if (vertices.empty()) continue;
    use(programs.shadowed, view, shadows);
    glScissor(box.left, box.bottom, box.right - box.left, box.top - box.bottom);
    buffer_.draw_triangles(vertices);
    ++statistics.num_draws;
  }
  glDisable(GL_SCISSOR_TEST);
}

void GroundPass::use(const gl::ShaderProgram& program, const RenderView& view,
                     const ShadowPass& shadows) const {
  use_lit(program, view, shadows);
  if (!field_dimensions_) return;
  set_field(program, *field_dimensions_);
  program.set("is_hall", is_hall_ ? 1 : 0);
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
  const int bottom = lowest_sky_row(world_from_clip, view, reach_);
  sky_.set("bottom", 2 * static_cast<float>(bottom) / static_cast<float>(view.height) - 1);
  sky_.set("num_cells", Eigen::Vector2i(kSkyColumns, kSkyRows));
  sky_vertices_.draw_triangles(6 * kSkyColumns * kSkyRows);
  ++statistics.num_draws;
}

}  // namespace nao
