#include "sim/islands.h"

#include <algorithm>

#include "sim/contact_detector.h"

namespace nao::sim {

void Islands::reserve(int num_robots, bool has_ball) {
  num_robots_ = num_robots;
  has_ball_ = has_ball;
  const int num_bodies = num_robots + (has_ball ? 1 : 0);
  parents_.resize(num_bodies);
  island_of_root_.resize(num_bodies);
  islands_.resize(num_bodies);
  for (Island& island : islands_) island.robots.reserve(num_robots);
}

int Islands::root_of(int body) const {
  while (parents_[body] != body) body = parents_[body];
  return body;
}

void Islands::connect(int a, int b) {
  const int root_a = root_of(a);
  const int root_b = root_of(b);
  parents_[std::max(root_a, root_b)] = std::min(root_a, root_b);
}

std::span<const Island> Islands::find(const ContactDetector& detector) {
  const int num_bodies = static_cast<int>(parents_.size());
  for (int body = 0; body < num_bodies; ++body) parents_[body] = body;
  for (int a = 0; a < num_robots_; ++a) {
    for (int b = a + 1; b < num_robots_; ++b) {
      if (detector.are_near(a, b)) connect(a, b);
    }
    if (has_ball_ && detector.is_near_ball(a)) connect(a, num_robots_);
  }
  int count = 0;
  for (int body = 0; body < num_bodies; ++body) {
    const int root = root_of(body);
    if (root == body) {
      island_of_root_[root] = count++;
      islands_[island_of_root_[root]].robots.clear();
      islands_[island_of_root_[root]].has_ball = false;
    }
    Island& island = islands_[island_of_root_[root]];
    if (body < num_robots_) {
      island.robots.push_back(body);
    } else {
      island.has_ball = true;
    }
  }
  return {islands_.data(), static_cast<size_t>(count)};
}

}  // namespace nao::sim
