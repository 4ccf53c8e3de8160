#pragma once

#include <memory>
#include <optional>

#include "daemons/play/keeper.h"
#include "daemons/play/positioner.h"
#include "daemons/play/situation.h"
#include "daemons/play/striker.h"

namespace nao::play {

/** Plays a match: takes its place for the kick-off, stands where the rules require it, and
 * otherwise plays its role in the team: striker, supporter or keeper. */
class AutoPlayer : public BehaviorMachine {
 public:
  /** @param constants  Must outlive this. */
  explicit AutoPlayer(const PlayConstants& constants);

  Decision step(const Situation& situation) override;
  void restart() override;

 private:
  /** Whether the robot itself has seen the ball recently. */
  bool sees_ball(const Situation& situation) const;
  /** Position of the ball as the team knows it, or where the rules put it, m, on the field. */
  std::optional<Eigen::Vector2d> find_ball(const Situation& situation) const;
  /** Notes the referee's message that the ball has left the field. */
  void note_ball_out(const Situation& situation);
  Decision stand(const Situation& situation, const Reason& reason);
  Decision take_place(const Situation& situation);
  Decision play(const Situation& situation);
  Decision strike(const Situation& situation);
  /** Walks to a ball that only teammates see. */
  Decision go_where_told(const Situation& situation, const Eigen::Vector2d& ball);
  /** While the others have a free kick. */
  Decision keep_away(const Situation& situation, const Eigen::Vector2d& ball,
                     const Eigen::Vector2d& position);
  Decision support(const Situation& situation, const Eigen::Vector2d& ball);
  /** Whether the keeper leaves its place to kick away a ball in front of it. */
  bool is_to_be_cleared(const Situation& situation, const std::optional<Eigen::Vector2d>& ball,
                        const Eigen::Vector2d& position) const;
  /** Where the robot goes while the others have a free kick, m, on the field; nothing: it is far
   * enough from the ball. */
  std::optional<Eigen::Vector2d> place_off_free_kick(const Eigen::Vector2d& ball,
                                                     const Eigen::Vector2d& position) const;
  bool must_wait_for_kick_off(const Situation& situation,
                              const std::optional<Eigen::Vector2d>& ball) const;

  const PlayConstants& constants_;
  const PlayParameters::AutoPlayer& parameters_;
  Positioner positioner_;
  Keeper keeper_;
  std::unique_ptr<Striker> striker_;
  PlayRole role_ = PlayRole::kNone;
  bool is_clearing_ = false;
  /** Where the ball was probably put after it had left the field, m, on the field, and when, s. */
  std::optional<Eigen::Vector2d> restart_{};
  double restart_time_ = -1e9;
};

}  // namespace nao::play
