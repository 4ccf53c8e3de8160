#include "rendering/mesh_programs.h"

#include "rendering/shadow_pass.h"
#include "shader_texts.h"

namespace nao {
namespace {

/** Transforms points of the mesh: pose times scale. */
Eigen::Matrix4f world_from_mesh(const MeshInstance& instance) {
  Eigen::Matrix4f matrix = instance.pose_in_world.matrix();
  for (int axis = 0; axis < 3; ++axis) matrix.col(axis) *= instance.scale[axis];
  return matrix;
}

/** Transforms normals of the mesh: the inverse transpose of world_from_mesh(), that is the rotation
 * times the inverse scale. */
Eigen::Matrix4f normal_from_mesh(const MeshInstance& instance) {
  Eigen::Matrix4f matrix = instance.pose_in_world.matrix();
  for (int axis = 0; axis < 3; ++axis) matrix.col(axis) /= instance.scale[axis];
  return matrix;
}

void draw_and_count(const MeshDraws& draws, const MeshDraws::Draw& draw,
                    RenderStatistics& statistics) {
  draws.draw(draw);
  ++statistics.num_draws;
  statistics.num_triangles += draw.num_indices / 3;
}

}  // namespace

gl::ShaderProgram compile(const std::vector<std::string>& parts,
                          const std::vector<std::string>& defines) {
  std::string text;
  for (const std::string& define : defines) text += "#define " + define + "\n";
  for (const std::string& part : parts) text += kShaderTexts.at(part);
  const std::string version = "#version 330 core\n";
  return {parts.back(), version + "#define VERTEX\n" + text, version + text};
}

void use_lit(const gl::ShaderProgram& program, const RenderView& view, const ShadowPass& shadows) {
  program.use();
  program.set("clip_from_world", view.clip_from_world);
  program.set("eye_position", view.eye);
  const SceneAppearance& look = view.appearance;
  program.set("light_direction", look.light_direction);
  program.set("direct_light", look.direct_light);
  program.set("ambient_light", look.ambient_light);
  program.set("shade", look.shade);
  program.set("shade_depth", look.shade_depth);
  shadows.set_uniforms(program);
}

DepthProgram::DepthProgram() : program_(compile({"depth"})) {}

void DepthProgram::draw(const MeshDraws& draws, const Eigen::Matrix4f& clip_from_world,
                        RenderStatistics& statistics) const {
  program_.use();
  for (const MeshDraws::Draw& draw : draws.draws()) {
    program_.set("clip_from_mesh",
                 Eigen::Matrix4f(clip_from_world * world_from_mesh(draw.instance)));
    draw_and_count(draws, draw, statistics);
  }
}

// One use_lit() for all: only the matrices change from one to the next.
void LitProgram::draw(const MeshDraws& draws, const RenderView& view, const ShadowPass& shadows,
                      RenderStatistics& statistics) const {
  if (draws.draws().empty()) return;
  use_lit(program_, view, shadows);
  for (const MeshDraws::Draw& draw : draws.draws()) {
    const Eigen::Matrix4f model_matrix = world_from_mesh(draw.instance);
    program_.set("clip_from_mesh", Eigen::Matrix4f(view.clip_from_world * model_matrix));
    program_.set("world_from_mesh", model_matrix);
    program_.set("normal_from_mesh", normal_from_mesh(draw.instance));
    program_.set("tint", draw.instance.tint);
    draw_and_count(draws, draw, statistics);
  }
}

}  // namespace nao
