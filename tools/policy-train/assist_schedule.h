#pragma once

#include <algorithm>

namespace nao::policy_train {

/** Force that pulls the torso of a robot up that learns to get up, as a fraction of its weight:
 * less after each episode that ends standing, until there is none, and more after each other one.
 * Method: T. Huang et al., "Learning Humanoid Standing-up Control across Diverse Postures", RSS
 * 2025. */
class AssistSchedule {
 public:
  /** @param greatest  The pull at first. */
  explicit AssistSchedule(double greatest) : greatest_(greatest), share_(greatest) {}

  double share() const { return share_; }

  void learn(bool stands) { share_ = std::clamp(share_ + (stands ? -kDown : kUp), 0.0, greatest_); }

 private:
  // Chosen: it ends after twenty successes, and falls as long as one episode of three succeeds.
  static constexpr double kDown = 0.03;
  static constexpr double kUp = 0.015;

  double greatest_;
  double share_;
};

}  // namespace nao::policy_train
