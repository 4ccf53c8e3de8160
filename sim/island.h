#pragma once

#include <vector>

namespace nao::sim {

/** Bodies that cannot touch a body outside the island within a step. */
struct Island {
  /** Indices, rising. */
  std::vector<int> robots;
  bool has_ball = false;
};

}  // namespace nao::sim
