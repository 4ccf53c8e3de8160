#include "daemons/referee/referee_core.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/error.h"
#include "daemons/referee/places.h"

namespace nao::referee {
namespace {

using Eigen::Vector2d;

/** Distance within which a robot is at its place, m. Chosen: what robots reach without further
 * steps. */
constexpr double kPlaceTolerance = 0.4;
/** Greatest time of one step, s: during longer gaps (the simulator was restarted or paused) nothing
 * was observed. */
constexpr double kMaxStep = 1;

}  // namespace

RefereeCore::RefereeCore(const std::vector<MatchPlayer>& players, const SceneFile& scene,
                         const Rules& rules, int64_t match_id)
    : scene_(scene), rules_(rules), watches_(players.size()) {
  // Throws if the scene is not for matches.
  (void)judge_ball(Eigen::Vector3d::Zero(), std::nullopt, scene);
  state_.id = match_id;
  state_.players = players;
  state_.time_left = rules.half_duration;
  for (int team = 0; team < 2; ++team) {
    if (team_size(team) == 0) {
      throw ConfigError("team " + std::to_string(team) +
                        " has no robot; name them NAME:MODEL:TEAM:NUMBER");
    }
  }
}

void RefereeCore::restore(const MatchState& state) {
  const std::vector<MatchPlayer> players = std::move(state_.players);
  state_ = state;
  state_.players = players;
  for (MatchPlayer& player : state_.players) {
    if (const MatchPlayer* before = find_player(state, player.robot)) {
      player.penalty = before->penalty;
      player.penalty_left = before->penalty_left;
    }
  }
}

int RefereeCore::team_size(int team) const {
  return static_cast<int>(
      std::count_if(state_.players.begin(), state_.players.end(),
                    [&](const MatchPlayer& player) { return player.team == team; }));
}

void RefereeCore::add_event(MatchEventKind kind, int team, const std::string& robot) {
  state_.event = {state_.event.id + 1, kind, team, robot, time_};
  output_.events.push_back(state_.event);
}

void RefereeCore::enter(MatchPhase phase) {
  state_.phase = phase;
  phase_time_ = 0;
}

void RefereeCore::begin_kick_off(int team) {
  state_.kickoff_team = team;
  last_team_.reset();
  exit_.reset();
  free_kick_.reset();
  untouched_time_ = 0;
  enter(MatchPhase::kReady);
}

void RefereeCore::begin_half(int half) {
  state_.half = half;
  state_.time_left = rules_.half_duration;
  begin_kick_off(half - 1);
}

void RefereeCore::end_half() {
  state_.time_left = 0;
  add_event(MatchEventKind::kHalfEnd, -1);
  for (size_t i = 0; i < state_.players.size(); ++i) {
    if (state_.players[i].penalty != Penalty::kNone) release(i);
  }
  if (state_.half == 1) {
    begin_half(2);
  } else {
    finish();
  }
}

void RefereeCore::finish() {
  free_kick_.reset();
  add_event(MatchEventKind::kMatchEnd, -1);
  enter(MatchPhase::kFinished);
}

void RefereeCore::run_clock(double dt) {
  // Before the first whistle of a half it stands.
  const bool runs = state_.phase == MatchPhase::kPlaying || state_.time_left < rules_.half_duration;
  if (runs) state_.time_left = std::max(0.0, state_.time_left - dt);
}

void RefereeCore::award_goal(int team) {
  ++state_.score[static_cast<size_t>(team)];
  add_event(MatchEventKind::kGoal, team);
  if (std::abs(state_.score[0] - state_.score[1]) >= rules_.mercy_goals) {
    finish();
  } else {
    begin_kick_off(1 - team);
  }
}

void RefereeCore::penalize(size_t player, Penalty penalty) {
  MatchPlayer& who = state_.players[player];
  who.penalty = penalty;
  int& num_before = num_penalties_[static_cast<size_t>(who.team)];
  who.penalty_left = rules_.penalty_duration + rules_.penalty_increment * num_before;
  if (penalty != Penalty::kNotGettingUp) ++num_before;
  watches_[player] = {};
  add_event(MatchEventKind::kPenalty, who.team, who.robot);
  output_.placements.push_back(penalty_place(who, scene_));
}

void RefereeCore::release(size_t player) {
  MatchPlayer& who = state_.players[player];
  who.penalty = Penalty::kNone;
  who.penalty_left = 0;
  watches_[player] = {};
  add_event(MatchEventKind::kPenaltyEnd, who.team, who.robot);
}

void RefereeCore::count_penalties(double dt, const RefereeInput& input) {
  for (size_t i = 0; i < state_.players.size(); ++i) {
    MatchPlayer& player = state_.players[i];
    if (const RobotSighting* robot = find_robot(input, player.robot)) {
      player.is_autonomous = robot->is_autonomous;
      player.role = robot->role;
    }
    if (player.penalty == Penalty::kNone) continue;
    player.penalty_left = std::max(0.0, player.penalty_left - dt);
    if (player.penalty_left == 0) release(i);
  }
}

void RefereeCore::watch_robots(double dt, const RefereeInput& input) {
  const FieldDimensions& field = *scene_.field;
  const Vector2d carpet =
      Vector2d(0.5 * field.length, 0.5 * field.width).array() + field.border_strip_width;
  for (size_t i = 0; i < state_.players.size(); ++i) {
    const MatchPlayer& player = state_.players[i];
    const RobotSighting* robot = find_robot(input, player.robot);
    if (player.penalty != Penalty::kNone || robot == nullptr) continue;
    Watch& watch = watches_[i];
    watch.down_time = robot->is_upright ? 0 : watch.down_time + dt;
    const bool is_outside = (robot->position.cwiseAbs() - carpet).maxCoeff() > 0;
    watch.outside_time = is_outside ? watch.outside_time + dt : 0;
    if (watch.outside_time > rules_.max_outside_duration) {
      penalize(i, Penalty::kLeftField);
    } else if (watch.down_time > rules_.max_down_duration) {
      penalize(i, Penalty::kNotGettingUp);
    }
  }
}

bool RefereeCore::is_in_place(const MatchPlayer& player, const RobotSighting& robot) const {
  return is_legal_at_kick_off(player, robot, state_, scene_) &&
         (!player.is_autonomous ||
          (robot.position - kick_off_place_of(player, state_, scene_).position).norm() <
              kPlaceTolerance);
}

// Robots walk to their places; at the end those in forbidden places are put there.
void RefereeCore::wait_for_robots(const RefereeInput& input) {
  bool is_prepared = phase_time_ >= rules_.min_ready_duration;
  for (const MatchPlayer& player : state_.players) {
    const RobotSighting* robot = find_robot(input, player.robot);
    if (robot == nullptr || player.penalty != Penalty::kNone) continue;
    is_prepared = is_prepared && is_in_place(player, *robot);
  }
  if (!is_prepared && phase_time_ < rules_.max_ready_duration) return;
  for (const Placement& placement : prepare_kick_off(input, state_, scene_)) {
    output_.placements.push_back(placement);
  }
  enter(MatchPhase::kSet);
}

void RefereeCore::watch_free_kick(double dt, const RefereeInput& input) {
  if (!free_kick_) return;
  const FreeKick::Judgement judgement = free_kick_->step(dt, input, state_.players, scene_);
  for (size_t i = 0; i < state_.players.size(); ++i) {
    const auto& offenders = judgement.offenders;
    const bool is_offender =
        std::find(offenders.begin(), offenders.end(), state_.players[i].robot) != offenders.end();
    if (is_offender) penalize(i, Penalty::kOperator);
  }
  if (judgement.is_retaken) {
    output_.placements.push_back({"", {free_kick_->ball(), 0}});
  } else if (judgement.is_over) {
    // After a kick-off it is told by the time since then.
    if (free_kick_->kind() != KickKind::kKickOff) {
      add_event(MatchEventKind::kBallFree, free_kick_->team());
    }
    free_kick_.reset();
  }
}

void RefereeCore::watch_play(double dt, const RefereeInput& input) {
  untouched_time_ += dt;
  for (const RobotSighting& robot : input.robots) {
    const MatchPlayer* player = find_player(state_, robot.name);
    if (player == nullptr || !robot.touches_ball) continue;
    last_team_ = player->team;
    untouched_time_ = 0;
  }
  watch_robots(dt, input);
  watch_free_kick(dt, input);
  if (exit_) {
    return_in_ -= dt;
    if (return_in_ <= 0) {
      output_.placements.push_back({"", {exit_->restart, 0}});
      free_kick_.emplace(exit_->kind, exit_->restart_team, exit_->restart);
      exit_.reset();
    }
  } else if (const auto exit = judge_ball(input.ball, last_team_, scene_)) {
    if (exit->goal_of) {
      award_goal(*exit->goal_of);
      return;
    }
    add_event(MatchEventKind::kBallOut, exit->restart_team);
    exit_ = exit;
    free_kick_.reset();
    return_in_ = rules_.ball_return_delay;
  }
  if (untouched_time_ > rules_.max_untouched_duration) {
    begin_kick_off(1 - state_.kickoff_team);
  }
}

RefereeOutput RefereeCore::step(const RefereeInput& input) {
  const bool is_restarted = has_time_ && input.time < time_;
  const double dt = has_time_ ? std::clamp(input.time - time_, 0.0, kMaxStep) : 0;
  time_ = input.time;
  has_time_ = true;
  const bool is_on = state_.phase != MatchPhase::kInitial && state_.phase != MatchPhase::kFinished;
  // A new simulator has reset everything: the half continues with a kick-off.
  if (is_restarted && is_on) begin_kick_off(state_.kickoff_team);
  phase_time_ += dt;
  count_penalties(is_on && state_.phase != MatchPhase::kSet ? dt : 0, input);
  if (is_on) run_clock(dt);
  switch (state_.phase) {
    case MatchPhase::kReady:
      watch_robots(dt, input);
      wait_for_robots(input);
      break;
    case MatchPhase::kSet:
      if (phase_time_ < rules_.set_duration) break;
      enter(MatchPhase::kPlaying);
      add_event(MatchEventKind::kKickOff, state_.kickoff_team);
      free_kick_.emplace(KickKind::kKickOff, state_.kickoff_team, Vector2d::Zero());
      break;
    case MatchPhase::kPlaying:
      watch_play(dt, input);
      break;
    default:
      break;
  }
  const bool is_still_on = is_on && state_.phase != MatchPhase::kFinished;
  if (is_still_on && state_.time_left <= 0) end_half();
  return std::exchange(output_, {});
}

std::optional<Reason> RefereeCore::overrule(const MatchCommand& command) {
  if (auto fault = check(command)) return fault;
  const auto team = static_cast<size_t>(command.team);
  size_t player = 0;
  if (needs_robot(command.operation)) {
    std::string known;
    while (player < state_.players.size() && state_.players[player].robot != command.robot) {
      known += (known.empty() ? "" : ", ") + state_.players[player].robot;
      ++player;
    }
    if (player == state_.players.size())
      return Reason("match-robot-unknown", {command.robot, known});
  }
  const Reason too_late("match-operation-too-late", {std::string(to_string(command.operation)),
                                                     std::string(to_string(state_.phase))});
  const bool is_on = state_.phase != MatchPhase::kInitial && state_.phase != MatchPhase::kFinished;
  if (!is_on && command.operation != MatchOperation::kStart &&
      command.operation != MatchOperation::kNewMatch) {
    return too_late;
  }
  switch (command.operation) {
    case MatchOperation::kStart:
      if (state_.phase != MatchPhase::kInitial) return too_late;
      begin_half(1);
      break;
    case MatchOperation::kKickOff:
      begin_kick_off(command.team);
      break;
    case MatchOperation::kGoal:
      award_goal(command.team);
      break;
    case MatchOperation::kTakeBackGoal:
      state_.score[team] = std::max(0, state_.score[team] - 1);
      break;
    case MatchOperation::kPenalize:
      penalize(player, Penalty::kOperator);
      break;
    case MatchOperation::kRelease:
      if (state_.players[player].penalty != Penalty::kNone) release(player);
      break;
    case MatchOperation::kEndHalf:
      end_half();
      break;
    case MatchOperation::kFinish:
      finish();
      break;
    case MatchOperation::kNewMatch: {
      MatchState fresh;
      fresh.id = state_.id + 1;
      fresh.players = state_.players;
      for (MatchPlayer& each : fresh.players) each.penalty = Penalty::kNone;
      fresh.time_left = rules_.half_duration;
      state_ = fresh;
      watches_.assign(state_.players.size(), {});
      num_penalties_ = {};
      enter(MatchPhase::kInitial);
      break;
    }
  }
  return std::nullopt;
}

}  // namespace nao::referee
