#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

namespace nao::gateway {

/** What the visitors of an exhibition try: to walk the robot, or to kick the ball, through a gate.
 */
struct ChallengeSettings {
  /** Posts of the gate, m, in the fence's frame; empty: no challenge. */
  std::vector<Eigen::Vector2d> posts;
  /** The ball must pass them, as through a goal; else the robot. */
  bool is_goal = false;
};

/** Watches whether the challenge is done. Without clock, bus or thread. */
class Challenge {
 public:
  explicit Challenge(ChallengeSettings settings = {}) : settings_(std::move(settings)) {}

  /** @param place  Of the robot's torso, or of the ball if that must pass, m, in the fence's frame;
   * empty: not known, and the way until it is known again does not count.
   * @return whether it has passed the gate since the last step: the robot from either side, the
   * ball only from the side of the frame's origin, for it may be taken back by hand. */
  bool step(const std::optional<Eigen::Vector2d>& place);

  const ChallengeSettings& settings() const { return settings_; }

 private:
  ChallengeSettings settings_;
  std::optional<Eigen::Vector2d> last_place_;
};

}  // namespace nao::gateway
