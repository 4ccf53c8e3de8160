#pragma once

namespace nao {

/** Counts of one image. */
struct RenderStatistics {
  int num_draws = 0;
  /** Triangles of meshes; the ground, the sky and markings are not counted. */
  int num_triangles = 0;
};

}  // namespace nao
