#include "daemons/referee/game_controller_referee.h"

#include <algorithm>

#include "daemons/referee/ball_judge.h"
#include "daemons/referee/places.h"

namespace nao::referee {
namespace {

using Eigen::Vector2d;
using SetPlay = GameControllerData::SetPlay;
using State = GameControllerData::State;

MatchPhase phase_of(State state) {
  switch (state) {
    case State::kReady:
      return MatchPhase::kReady;
    case State::kSet:
      return MatchPhase::kSet;
    case State::kPlaying:
      return MatchPhase::kPlaying;
    case State::kFinished:
      return MatchPhase::kFinished;
    // In standby robots wait for the referee's gesture and must not move either.
    default:
      return MatchPhase::kInitial;
  }
}

/** Whether a message is about these two teams, in either order. */
bool is_about(const GameControllerData& data, const std::array<int, 2>& numbers) {
  const std::array<int, 2> said{data.teams[0].number, data.teams[1].number};
  const std::array<int, 2> swapped{said[1], said[0]};
  return said == numbers || swapped == numbers;
}

/** Where the ball lies at a set play, m, in the field frame (SPL rules, "Free Kicks"); nothing:
 * where it is. @param team  That has the kick. */
std::optional<Vector2d> ball_place(SetPlay set_play, int team, const Vector2d& ball,
                                   const FieldDimensions& field) {
  const Vector2d half(0.5 * field.length, 0.5 * field.width);
  // The end that the team attacks.
  const double attack = team == 0 ? 1 : -1;
  const double side = ball.y() > 0 ? 1 : -1;
  switch (set_play) {
    case SetPlay::kGoalKick:
      return Vector2d(-attack * (half.x() - field.goal_area_length),
                      side * 0.5 * field.goal_area_width);
    case SetPlay::kCornerKick:
      return Vector2d(attack * half.x(), side * half.y());
    case SetPlay::kKickIn:
      return Vector2d(std::clamp(ball.x(), -half.x(), half.x()), side * half.y());
    case SetPlay::kPenaltyKick:
      return Vector2d(attack * (half.x() - field.penalty_mark_distance), 0);
    default:
      return std::nullopt;
  }
}

}  // namespace

GameControllerReferee::GameControllerReferee(const std::vector<MatchPlayer>& players,
                                             const SceneFile& scene,
                                             std::optional<std::array<int, 2>> team_numbers,
                                             int64_t match_id)
    : scene_(scene),
      team_numbers_(team_numbers),
      numbers_(team_numbers.value_or(std::array{0, 0})) {
  // Throws if the scene is not for matches.
  (void)judge_ball(Eigen::Vector3d::Zero(), std::nullopt, scene);
  state_.id = match_id;
  state_.players = players;
}

bool GameControllerReferee::concerns(const GameControllerData& data) const {
  return !team_numbers_ || is_about(data, *team_numbers_);
}

void GameControllerReferee::receive(const GameControllerData& data) {
  if (!is_about(data, numbers_)) numbers_ = {data.teams[0].number, data.teams[1].number};
  is_swapped_ = data.teams[0].number != numbers_[0];
  data_ = data;
}

int GameControllerReferee::team_number(int team) const {
  return data_ ? data_->teams[index_of(team)].number : 0;
}

std::optional<int> GameControllerReferee::team_of(int number) const {
  for (int team = 0; team < 2; ++team) {
    if (team_number(team) == number) return team;
  }
  return std::nullopt;
}

void GameControllerReferee::restore(const MatchState& state) {
  const std::vector<MatchPlayer> players = std::move(state_.players);
  state_ = state;
  called_phase_ = state.phase;
  state_.players = players;
}

void GameControllerReferee::add_event(MatchEventKind kind, int team, const std::string& robot) {
  state_.event = {state_.event.id + 1, kind, team, robot, time_};
  output_.events.push_back(state_.event);
}

void GameControllerReferee::follow_score() {
  for (int team = 0; team < 2; ++team) {
    int& score = state_.score[static_cast<size_t>(team)];
    const int said = data_->teams[index_of(team)].score;
    while (score < said) {
      ++score;
      add_event(MatchEventKind::kGoal, team);
    }
    score = said;
  }
}

void GameControllerReferee::follow_phase(const RefereeInput& input) {
  state_.half = data_->is_first_half ? 1 : 2;
  state_.time_left = std::max(0, data_->time_left);
  if (const auto team = team_of(data_->kicking_team)) state_.kickoff_team = *team;
  const MatchPhase phase = phase_of(data_->state);
  // While play is stopped robots stand still, as in "set".
  const bool is_moving = phase == MatchPhase::kReady || phase == MatchPhase::kPlaying;
  state_.phase = data_->is_stopped && is_moving ? MatchPhase::kSet : phase;
  const MatchPhase before = std::exchange(called_phase_, phase);
  if (phase == before) return;
  if (phase == MatchPhase::kSet && data_->set_play != SetPlay::kPenaltyKick) {
    for (const Placement& placement : prepare_kick_off(input, state_, scene_)) {
      output_.placements.push_back(placement);
    }
  }
  if (phase == MatchPhase::kPlaying && before == MatchPhase::kSet) {
    add_event(MatchEventKind::kKickOff, state_.kickoff_team);
  }
  if (phase == MatchPhase::kFinished) {
    add_event(MatchEventKind::kHalfEnd, -1);
    if (state_.half == 2) add_event(MatchEventKind::kMatchEnd, -1);
  }
}

void GameControllerReferee::follow_penalties() {
  for (MatchPlayer& player : state_.players) {
    const auto& players = data_->teams[index_of(player.team)].players;
    const size_t index = static_cast<size_t>(player.number) - 1;
    if (index >= players.size()) continue;
    const Penalty penalty = players[index].kind;
    player.penalty_left = players[index].time_left;
    if (penalty == player.penalty) continue;
    const bool is_new = player.penalty == Penalty::kNone;
    player.penalty = penalty;
    if (penalty == Penalty::kNone) {
      add_event(MatchEventKind::kPenaltyEnd, player.team, player.robot);
    } else if (is_new) {
      add_event(MatchEventKind::kPenalty, player.team, player.robot);
      output_.placements.push_back(penalty_place(player, scene_));
    }
  }
}

void GameControllerReferee::follow_set_play(const RefereeInput& input) {
  const SetPlay set_play = data_->set_play;
  if (set_play == set_play_) return;
  if (set_play == SetPlay::kNone) add_event(MatchEventKind::kBallFree, -1);
  set_play_ = set_play;
  const auto team = team_of(data_->kicking_team);
  if (!team || set_play == SetPlay::kNone) return;
  if (set_play != SetPlay::kFreeKick && set_play != SetPlay::kPenaltyKick) {
    add_event(MatchEventKind::kBallOut, *team);
  }
  if (const auto place = ball_place(set_play, *team, input.ball.head<2>(), *scene_.field)) {
    output_.placements.push_back({"", {*place, 0}});
  }
}

RefereeOutput GameControllerReferee::step(const RefereeInput& input) {
  for (MatchPlayer& player : state_.players) {
    if (const RobotSighting* robot = find_robot(input, player.robot)) {
      player.is_autonomous = robot->is_autonomous;
      player.role = robot->role;
    }
  }
  if (!data_) return {};
  time_ = input.time;
  follow_score();
  follow_phase(input);
  follow_penalties();
  follow_set_play(input);
  return std::exchange(output_, {});
}

std::optional<Reason> GameControllerReferee::overrule(const MatchCommand& /*command*/) {
  return Reason("match-by-game-controller");
}

}  // namespace nao::referee
