#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "rendering/gl_objects.h"
#include "rendering/mesh_draws.h"
#include "rendering/render_statistics.h"
#include "rendering/render_view.h"

namespace nao {

class ShadowPass;

/** Compiles a shader of shaders/. @param parts  Its files, in this order, without ending. They are
 * read twice, the first time with VERTEX defined. @param defines  What else is defined. */
gl::ShaderProgram compile(const std::vector<std::string>& parts,
                          const std::vector<std::string>& defines = {});

/** Shader that writes the depth of meshes and no color. */
class DepthProgram {
 public:
  DepthProgram();

  void draw(const MeshDraws& draws, const Eigen::Matrix4f& clip_from_world,
            RenderStatistics& statistics) const;

 private:
  gl::ShaderProgram program_;
};

/** Shader of lit meshes. */
class LitProgram {
 public:
  LitProgram(const std::vector<std::string>& parts, const std::vector<std::string>& defines)
      : program_(compile(parts, defines)) {}

  void draw(const MeshDraws& draws, const RenderView& view, const ShadowPass& shadows,
            RenderStatistics& statistics) const;

 private:
  gl::ShaderProgram program_;
};

/** Makes a program that includes the lighting shader the current one, and sets its camera, light
 * and shadow map. */
void use_lit(const gl::ShaderProgram& program, const RenderView& view, const ShadowPass& shadows);

}  // namespace nao
