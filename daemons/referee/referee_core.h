#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "daemons/referee/ball_judge.h"
#include "kinematics/pose2.h"
#include "messages/match_command.h"
#include "messages/match_state.h"
#include "robot_model/scene_file.h"

namespace nao::referee {

/** Durations, s, of simulated time. */
struct Rules {
  /** Of a half. Chosen: half of the league's, for visitors. */
  double half_duration = 300;
  /** In which the robots walk to their places for a kick-off (SPL rules: 45 s), and which they have
   * at least. */
  double max_ready_duration = 45;
  double min_ready_duration = 10;
  /** In which they stand there before the whistle. Chosen: long enough to see it. */
  double set_duration = 3;
  /** In which a penalised robot stands beside the field. Chosen: shorter than the league's 45 s. */
  double penalty_duration = 30;
  /** A robot that is not upright (SPL rules: 20 s) or outside the carpet for so long is penalised.
   */
  double max_down_duration = 20;
  double max_outside_duration = 5;
  /** From the ball's leaving the field to its being put back. Chosen: long enough to see it. */
  double ball_return_delay = 1;
  /** A match in which nobody touches the ball for so long goes on with a kick-off. Chosen: a robot
   * that has lost the ball searches half of the field meanwhile. */
  double max_untouched_duration = 60;
};

/** A robot as the referee sees it. */
struct RobotSighting {
  std::string name;
  /** m, in the field frame: x along team 0's attack, y left. */
  Eigen::Vector2d position = Eigen::Vector2d::Zero();
  bool is_upright = true;
  bool touches_ball = false;
  bool is_autonomous = false;
  PlayRole role = PlayRole::kNone;
};

struct RefereeInput {
  /** Robot time, s. */
  double time = 0;
  /** Ball center, m, in the field frame. */
  Eigen::Vector3d ball = Eigen::Vector3d::Zero();
  std::vector<RobotSighting> robots{};
};

/** What the referee's hands do: put the ball, or a robot on its feet, somewhere. */
struct Placement {
  /** Empty: the ball. */
  std::string robot{};
  /** In the field frame. */
  Pose2 pose;
};

struct RefereeOutput {
  std::vector<Placement> placements;
  std::vector<MatchEvent> events;
};

/** A referee without clock and bus: kick-offs, goals, ball out, time, penalties. The clock of a
 * half runs in the phase playing only. Teams do not change sides. */
class RefereeCore {
 public:
  /** @param players  Robots, teams and numbers. @param scene  With field, goals and ball.
   * @throws ConfigError  if it has none, or a team has no player. */
  RefereeCore(const std::vector<MatchPlayer>& players, const SceneFile& scene, const Rules& rules,
              int64_t match_id);

  /** Goes on with a match that another referee began; with its own players. */
  void restore(const MatchState& state);

  RefereeOutput step(const RefereeInput& input);

  /** Overrules. @return Nothing, or why not. */
  [[nodiscard]] std::optional<Reason> overrule(const MatchCommand& command);

  const MatchState& state() const { return state_; }

 private:
  /** What is counted for a player. */
  struct Watch {
    double down_time = 0;
    double outside_time = 0;
  };

  void add_event(MatchEventKind kind, int team, const std::string& robot = "");
  void enter(MatchPhase phase);
  void begin_kick_off(int team);
  void begin_half(int half);
  void end_half();
  void award_goal(int team);
  void penalize(size_t player, Penalty penalty);
  void release(size_t player);
  void count_penalties(double dt, const RefereeInput& input);
  void watch_robots(double dt, const RefereeInput& input);
  void prepare_kick_off(const RefereeInput& input);
  void watch_play(double dt, const RefereeInput& input);
  Pose2 place_of(const MatchPlayer& player) const;
  bool is_legal(const MatchPlayer& player, const RobotSighting& robot) const;
  bool is_in_place(const MatchPlayer& player, const RobotSighting& robot) const;
  int team_size(int team) const;

  SceneFile scene_;
  Rules rules_;
  MatchState state_;
  std::vector<Watch> watches_;
  RefereeOutput output_;
  double time_ = 0;
  bool has_time_ = false;
  /** Of the phase, s. */
  double phase_time_ = 0;
  std::optional<int> last_team_{};
  /** s without a touch of the ball. */
  double untouched_time_ = 0;
  /** Where the ball comes back to, and in how many s. */
  std::optional<BallExit> exit_{};
  double return_in_ = 0;
};

}  // namespace nao::referee
