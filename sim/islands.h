#pragma once

#include <span>
#include <vector>

#include "sim/island.h"

namespace nao::sim {

class ContactDetector;

/** Divides robots and ball into islands: the connected components of the graph whose edges are
 * pairs of bodies near each other. Floor and goals do not move and connect nothing. */
class Islands {
 public:
  /** Takes memory. */
  void reserve(int num_robots, bool has_ball);

  /** @param bodies  Those to divide. @param num_steps  Steps within which bodies of different
   * islands cannot touch. @param detector  Decides which bodies are near each other.
   * @return Ordered by their first robot; the ball's own one last. Valid until the next call.
   * Allocates nothing. */
  std::span<const Island> find(const Island& bodies, int num_steps,
                               const ContactDetector& detector);

 private:
  /** Representative of a body's component: its least body. The ball comes after the robots. */
  int root_of(int body) const;
  void connect(int a, int b);
  /** The island of a body; a new one for the first body of its component. */
  Island& island_of(int body);

  /** Index of the ball among the bodies: after the robots. */
  int ball_ = 0;
  std::vector<int> parents_;
  /** Index of a root's island. */
  std::vector<int> island_of_root_;
  std::vector<Island> islands_;
  int num_islands_ = 0;
};

}  // namespace nao::sim
