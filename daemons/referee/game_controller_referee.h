#pragma once

#include <array>
#include <optional>
#include <vector>

#include "daemons/referee/game_controller_message.h"
#include "daemons/referee/referee.h"
#include "robot_model/scene_file.h"

namespace nao::referee {

/** A referee that decides nothing: phases, score, clock and penalties are those that the RoboCup
 * GameController says. For the people who press the GameController's buttons, it puts ball and
 * robots where their decisions require. */
class GameControllerReferee : public Referee {
 public:
  /** @param team_numbers  The GameController's numbers of team 0 and team 1; messages about other
   *   teams are ignored. Nothing: of any two teams, in the order of the first message about them.
   * @throws ConfigError  if the scene has no field with goals and a ball. */
  GameControllerReferee(const std::vector<MatchPlayer>& players, const SceneFile& scene,
                        std::optional<std::array<int, 2>> team_numbers, int64_t match_id);

  /** Whether the message is about our teams. */
  bool concerns(const GameControllerData& data) const;
  /** The newest message that concerns us. */
  void receive(const GameControllerData& data);
  /** The GameController's number of a team; 0 before its first message. */
  int team_number(int team) const;

  void restore(const MatchState& state) override;
  RefereeOutput step(const RefereeInput& input) override;
  /** Refuses everything: the GameController decides. */
  [[nodiscard]] std::optional<Reason> overrule(const MatchCommand& command) override;
  const MatchState& state() const override { return state_; }

 private:
  /** Index in the message of one of our teams. */
  size_t index_of(int team) const {
    return is_swapped_ ? 1 - static_cast<size_t>(team) : static_cast<size_t>(team);
  }
  /** Our team of a GameController's number; nothing if it is none of them. */
  std::optional<int> team_of(int number) const;
  void add_event(MatchEventKind kind, int team, const std::string& robot = "");
  void follow_score();
  void follow_phase(const RefereeInput& input);
  void follow_penalties();
  void follow_set_play(const RefereeInput& input);

  SceneFile scene_;
  std::optional<std::array<int, 2>> team_numbers_;
  /** Numbers of team 0 and team 1, from the options or the first message about them. */
  std::array<int, 2> numbers_{};
  MatchState state_;
  std::optional<GameControllerData> data_{};
  bool is_swapped_ = false;
  /** The GameController's phase; state_ has "set" instead while play is stopped. */
  MatchPhase called_phase_ = MatchPhase::kInitial;
  GameControllerData::SetPlay set_play_ = GameControllerData::SetPlay::kNone;
  RefereeOutput output_;
  double time_ = 0;
};

}  // namespace nao::referee
