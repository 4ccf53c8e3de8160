#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "daemons/referee/ball_judge.h"
#include "daemons/referee/free_kick.h"
#include "daemons/referee/referee.h"
#include "robot_model/scene_file.h"

namespace nao::referee {

/** Durations, s, of simulated time, and numbers. "HSL": the leagues merged in 2026, division of
 * small robots; repository RoboCup-HumanoidSoccerLeague, HSL-Rules (rules/game.tex) and
 * GameController (config/small_foundation/params.yaml). */
struct Rules {
  /** Duration of a half, s. Chosen: half of the league's, for visitors. */
  double half_duration = 300;
  /** Greatest time in which the robots walk to their places for a kick-off (HSL: 45 s), and the
   * least. */
  double max_ready_duration = 45;
  double min_ready_duration = 10;
  /** Time for which they stand there before the whistle. Chosen: long enough to see it. */
  double set_duration = 3;
  /** Time for which a penalised robot stands beside the field (HSL: 30 s), and by how much it is
   * longer for each earlier penalty of its team, those for not getting up excepted (HSL: 15 s). */
  double penalty_duration = 30;
  double penalty_increment = 15;
  /** Goals ahead with which the match ends (HSL: 10). */
  int mercy_goals = 10;
  /** Time not upright (HSL: 20 s), and time outside the carpet, after which a robot is
   * penalised. */
  double max_down_duration = 20;
  double max_outside_duration = 5;
  /** Time from the ball leaving the field until it is put back. Chosen: long enough to see it. */
  double ball_return_delay = 1;
  /** Time without a touch of the ball after which the match continues with a kick-off. Chosen: in
   * this time a robot that has lost the ball searches half of the field. */
  double max_untouched_duration = 60;
};

/** Our own rules: kick-offs, free kicks, goals, ball out, time, penalties. The clock of a half runs
 * from its first whistle on, penalties run except in the phase set and end with the half (HSL).
 * Teams do not change sides. */
class RefereeCore : public Referee {
 public:
  /** @param players  Robots, teams and numbers. @param scene  With field, goals and ball.
   * @throws ConfigError  if it has none, or a team has no player. */
  RefereeCore(const std::vector<MatchPlayer>& players, const SceneFile& scene, const Rules& rules,
              int64_t match_id);

  void restore(const MatchState& state) override;
  RefereeOutput step(const RefereeInput& input) override;
  [[nodiscard]] std::optional<Reason> overrule(const MatchCommand& command) override;
  const MatchState& state() const override { return state_; }

 private:
  /** Counters of a player. */
  struct Watch {
    double down_time = 0;
    double outside_time = 0;
  };

  void add_event(MatchEventKind kind, int team, const std::string& robot = "");
  void enter(MatchPhase phase);
  void begin_kick_off(int team);
  void begin_half(int half);
  void end_half();
  void finish();
  void award_goal(int team);
  void run_clock(double dt);
  void penalize(size_t player, Penalty penalty);
  void release(size_t player);
  void count_penalties(double dt, const RefereeInput& input);
  void watch_robots(double dt, const RefereeInput& input);
  void wait_for_robots(const RefereeInput& input);
  void watch_play(double dt, const RefereeInput& input);
  void watch_free_kick(double dt, const RefereeInput& input);
  bool is_in_place(const MatchPlayer& player, const RobotSighting& robot) const;
  int team_size(int team) const;

  SceneFile scene_;
  Rules rules_;
  MatchState state_;
  std::vector<Watch> watches_;
  /** Penalties of each team that make its next one longer. */
  std::array<int, 2> num_penalties_{};
  RefereeOutput output_;
  double time_ = 0;
  bool has_time_ = false;
  /** Time since the start of the phase, s. */
  double phase_time_ = 0;
  std::optional<int> last_team_{};
  /** Time without a touch of the ball, s. */
  double untouched_time_ = 0;
  /** Where the ball will be put back, and the time until then, s. */
  std::optional<BallExit> exit_{};
  double return_in_ = 0;
  /** The kick that a team has for itself now. */
  std::optional<FreeKick> free_kick_{};
};

}  // namespace nao::referee
