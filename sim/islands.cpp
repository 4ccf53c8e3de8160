#include "sim/islands.h"

#include <algorithm>

#include "sim/contact_detector.h"

namespace nao::sim {

void Islands::reserve(int num_robots, bool has_ball) {
  ball_ = num_robots;
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

Island& Islands::island_of(int body) {
  const int root = root_of(body);
  if (root == body) {
    island_of_root_[root] = num_islands_++;
    islands_[island_of_root_[root]].robots.clear();
    islands_[island_of_root_[root]].has_ball = false;
  }
  return islands_[island_of_root_[root]];
}

std::span<const Island> Islands::find(const Island& bodies, int num_steps,
                                      const ContactDetector& detector) {
  for (const int robot : bodies.robots) parents_[robot] = robot;
  if (bodies.has_ball) parents_[ball_] = ball_;
  for (const int b : bodies.robots) {
    for (const int a : bodies.robots) {
      if (a >= b) break;
      if (detector.are_near(a, b, num_steps)) connect(a, b);
    }
    if (bodies.has_ball && detector.is_near_ball(b, num_steps)) connect(b, ball_);
  }
  num_islands_ = 0;
  for (const int robot : bodies.robots) island_of(robot).robots.push_back(robot);
  if (bodies.has_ball) island_of(ball_).has_ball = true;
  return {islands_.data(), static_cast<size_t>(num_islands_)};
}

}  // namespace nao::sim
