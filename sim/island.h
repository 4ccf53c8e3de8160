#pragma once

#include <vector>

namespace nao::sim {

/** Bodies of which none can touch one outside the island within a step. */
struct Island {
  /** Indices, rising. */
  std::vector<int> robots;
  bool has_ball = false;
};

}  // namespace nao::sim
