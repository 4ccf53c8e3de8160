#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "rendering/gl_objects.h"
#include "rendering/scene.h"

namespace nao {

/** The meshes that one pass draws, each reduced to the triangles that face the eye or the light. */
class MeshDraws {
 public:
  struct Draw {
    MeshInstance instance;
    const gl::MeshBuffer* buffer;
    /** First of the indices in the stream. */
    int first;
    int num_indices;
  };

  void clear();
  /** @param buffer  Must outlive the next clear(). @param from  The eye (x, y, z, 1), m, or a unit
   * vector towards the light (x, y, z, 0), in the world. */
  void add(const gl::MeshBuffer& buffer, const MeshInstance& instance, const Eigen::Vector4f& from);
  /** Sends the triangles to the driver: once after the last add(). */
  void upload();

  const std::vector<Draw>& draws() const { return draws_; }
  void draw(const Draw& draw) const { draw.buffer->draw(stream_, draw.first, draw.num_indices); }

 private:
  std::vector<Draw> draws_;
  std::vector<uint32_t> indices_;
  gl::IndexStream stream_;
};

}  // namespace nao
