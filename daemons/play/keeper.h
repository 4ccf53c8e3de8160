#pragma once

#include <optional>

#include "daemons/play/positioner.h"
#include "daemons/play/situation.h"

namespace nao::play {

/** Keeps its own goal: stands between ball and goal, sidesteps towards a slow ball, blocks a shot
 * at the body and dives for one beside it. */
class Keeper : public BehaviorMachine {
 public:
  /** @param constants  Must outlive this. */
  explicit Keeper(const PlayConstants& constants)
      : constants_(constants), parameters_(constants.parameters.keeper), positioner_(constants) {}

  Decision step(const Situation& situation) override;
  void restart() override { positioner_.stop_search(); }

 private:
  /** Target position of the feet, in the odometry frame. */
  Pose2 calc_place(const std::optional<Eigen::Vector2d>& ball, const Situation& situation) const;
  bool is_towards_goal(const Ball& ball, const Situation& situation) const;
  std::optional<Decision> answer_shot(const Ball& ball, const Situation& situation);
  Decision guard(const std::optional<Ball>& ball, const Situation& situation);

  const PlayConstants& constants_;
  const PlayParameters::Keeper& parameters_;
  Positioner positioner_;
  double last_action_ = -1e9;
};

}  // namespace nao::play
