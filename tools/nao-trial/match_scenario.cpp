#include "tools/nao-trial/scenarios.h"

#include <algorithm>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "common/error.h"
#include "common/output_file.h"
#include "daemons/play/match_view.h"
#include "daemons/referee/referee_core.h"
#include "kinematics/formation.h"
#include "messages/match_state.h"
#include "tools/nao-trial/play_trial.h"

namespace nao::trial {
namespace {

using Eigen::Vector2d;

/** Default duration of a match, s: two halves. */
constexpr double kDuration = 300;
/** Time between steps of the referee, and between messages of teammates, s. */
constexpr double kRefereePeriod = 0.05;
constexpr double kTellPeriod = 0.2;
/** A torso that leans by more than this, rad, is not on its feet. Chosen: nao-referee's value. */
constexpr double kMaxTilt = 0.8;
/** Displacement within a second, m, below which robots count as not moving: the match is stuck
 * while no robot moves or touches the ball. Chosen. */
constexpr double kMoved = 0.05;

/** A robot of a match. */
struct Player {
  MatchPlayer who;
  std::unique_ptr<ClosedLoop> loop;
  std::unique_ptr<PlayingRobot> robot;
  /** A teammate's knowledge. */
  play::TeamObservation observation;
  Vector2d last_place = Vector2d::Zero();
};

/** Counts what happened. */
struct Tally {
  int num_goals = 0;
  int num_outs = 0;
  int num_penalties = 0;
  double time = 0;
  double upright_time = 0;
  double stuck = 0;
  double longest_stuck = 0;
};

class Match {
 public:
  Match(const ScenarioOptions& options, const PerceptionFactory& perception, uint64_t seed)
      : options_(options), world_(ClosedLoop::make_world(options.trial, seed)) {
    std::vector<MatchPlayer> players;
    for (int team = 0; team < 2; ++team) {
      for (int number = 1; number <= options.team_sizes[team]; ++number) {
        add_player(team, number, perception, seed);
      }
    }
    for (const auto& player : players_) players.push_back(player->who);
    referee::Rules rules;
    rules.half_duration = 0.5 * (options.duration > 0 ? options.duration : kDuration);
    referee_ = std::make_unique<referee::RefereeCore>(players, options.trial.scene, rules,
                                                      static_cast<int64_t>(seed));
  }

  void play(RunResult& result) {
    if (referee_->overrule({MatchOperation::kStart, 0, ""})) throw Error("the match did not begin");
    // Twice the playing time plus a minute for kick-offs: a longer match counts as endless.
    const double limit =
        world_->time() + 2 * (options_.duration > 0 ? options_.duration : kDuration) + 900;
    while (referee_->state().phase != MatchPhase::kFinished && world_->time() < limit) step();
    const bool has_ended = referee_->state().phase == MatchPhase::kFinished;
    double num_falls = 0;
    double num_kicks = 0;
    for (const auto& player : players_) {
      num_falls += player->robot->num_falls();
      num_kicks += player->robot->num_actions();
    }
    result.metrics = {{"goals", static_cast<double>(tally_.num_goals)},
                      {"outs", static_cast<double>(tally_.num_outs)},
                      {"penalties", static_cast<double>(tally_.num_penalties)},
                      {"kicks", num_kicks},
                      {"falls", num_falls},
                      {"upright_ratio", tally_.upright_time / std::max(1e-9, tally_.time)},
                      {"longest_stuck_s", tally_.longest_stuck}};
    result.is_success = has_ended && tally_.num_goals > 0;
    if (!has_ended) {
      result.failure = "not finished";
    } else if (tally_.num_goals == 0) {
      result.failure = "no goal";
    }
    if (is_traced()) replace_file(options_.trace_file, trace_);
  }

 private:
  void add_player(int team, int number, const PerceptionFactory& perception, uint64_t seed) {
    auto player = std::make_unique<Player>();
    player->who.robot = (team == 0 ? "A" : "B") + std::to_string(number);
    player->who.team = team;
    player->who.number = number;
    player->loop = std::make_unique<ClosedLoop>(options_.trial, seed, world_);
    const FieldDimensions& field = *options_.trial.scene.field;
    const Pose2 start = kick_off_place(number, options_.team_sizes[team], false,
                                       {0.5 * field.length, 0.5 * field.width});
    player->robot = std::make_unique<PlayingRobot>(*player->loop, options_.trial.scene.name, start);
    place_standing(*player->loop, team_in_field(team) * start);
    player->robot->set_perception(
        perception(*player->loop, options_.trial.scene, start, seed, team));
    player->robot->command(Behavior::kAuto);
    players_.push_back(std::move(player));
  }

  void step() {
    world_->step_tick();
    for (const auto& player : players_) {
      player->loop->step_core();
      player->robot->step();
    }
    const double time = world_->time();
    if (is_traced()) trace_ball();
    if (time >= next_referee_) {
      next_referee_ = time + kRefereePeriod - 1e-6;
      step_referee();
    }
    if (time >= next_tell_) {
      next_tell_ = time + kTellPeriod - 1e-6;
      tell();
      if (is_traced()) trace_robots();
    }
  }

  void step_referee() {
    referee::RefereeInput input;
    input.time = world_->time();
    input.ball = world_->ball().position;
    for (const auto& player : players_) {
      referee::RobotSighting robot;
      robot.name = player->who.robot;
      robot.position = player->loop->torso_in_world().translation().head<2>();
      robot.is_upright = player->loop->torso_tilt() < kMaxTilt;
      robot.is_autonomous = true;
      robot.role = player->robot->core().state().role;
      input.robots.push_back(robot);
    }
    for (const sim::Contact& contact : world_->contacts()) {
      for (const auto& [robot, other] : {std::pair(contact.a, contact.b), {contact.b, contact.a}}) {
        if (robot.kind != sim::Surface::Kind::kRobot || other.kind != sim::Surface::Kind::kBall) {
          continue;
        }
        input.robots[static_cast<size_t>(robot.robot)].touches_ball = true;
      }
    }
    count(input);
    const referee::RefereeOutput output = referee_->step(input);
    for (const MatchEvent& event : output.events) {
      if (is_traced()) trace_event(event);
      tally_.num_goals += event.kind == MatchEventKind::kGoal;
      tally_.num_outs += event.kind == MatchEventKind::kBallOut;
      tally_.num_penalties += event.kind == MatchEventKind::kPenalty;
    }
    for (const referee::Placement& placement : output.placements) put(placement);
  }

  void put(const referee::Placement& placement) {
    const Vector2d& position = placement.pose.position;
    if (placement.robot.empty()) {
      world_->place_ball({position.x(), position.y(), 0}, Eigen::Vector3d::Zero());
      return;
    }
    for (const auto& player : players_) {
      if (player->who.robot != placement.robot) continue;
      ClosedLoop& loop = *player->loop;
      const Posture* posture = &loop.model().ready_posture();
      const Eigen::Quaterniond turned(
          Eigen::AngleAxisd(placement.pose.heading, Eigen::Vector3d::UnitZ()));
      world_->place_robot(loop.robot(), posture, {position.x(), position.y(), 0}, &turned);
      loop.restart_core();
    }
  }

  void count(const referee::RefereeInput& input) {
    if (referee_->state().phase != MatchPhase::kPlaying) {
      tally_.stuck = 0;
      return;
    }
    bool has_moved = false;
    for (size_t i = 0; i < players_.size(); ++i) {
      tally_.time += kRefereePeriod;
      if (input.robots[i].is_upright) tally_.upright_time += kRefereePeriod;
      has_moved |= input.robots[i].touches_ball;
      if ((input.robots[i].position - players_[i]->last_place).norm() < kMoved) continue;
      players_[i]->last_place = input.robots[i].position;
      has_moved = true;
    }
    tally_.stuck = has_moved ? 0 : tally_.stuck + kRefereePeriod;
    tally_.longest_stuck = std::max(tally_.longest_stuck, tally_.stuck);
  }

  /** Passes the messages of referee and teammates to the robots. */
  void tell() {
    const double time = world_->time();
    std::map<std::string, play::TeamObservation> seen;
    for (const auto& player : players_) {
      const play::Vision& vision = player->robot->vision();
      if (!vision.field_in_odometry) continue;
      const Pose2 in_field = vision.field_in_odometry->inverse();
      play::TeamObservation& told = seen[player->who.robot];
      told.time = vision.time;
      told.position = (in_field * Pose2::from(player->loop->estimate().torso_in_odometry)).position;
      if (vision.ball && time - vision.ball->seen_time < 0.3) {
        told.ball = in_field * vision.ball->position;
      }
    }
    for (const auto& player : players_) {
      player->robot->set_match(play::view_match(referee_->state(), player->who.robot, time, seen));
    }
  }

  bool is_traced() const { return !options_.trace_file.empty(); }

  /** Appends a row to the trace: its kind, the time, and values. */
  void trace_row(const std::string& kind, const std::vector<std::string>& values) {
    trace_ += kind + "," + std::to_string(world_->time());
    for (const std::string& value : values) trace_ += "," + value;
    trace_ += "\n";
  }

  void trace_ball() {
    const Eigen::Vector3d ball = world_->ball().position;
    trace_row("ball", {std::string(to_string(referee_->state().phase)), std::to_string(ball.x()),
                       std::to_string(ball.y()), std::to_string(ball.z())});
  }

  void trace_event(const MatchEvent& event) {
    trace_row("event", {std::string(to_string(event.kind)), std::to_string(event.team)});
  }

  void trace_robots() {
    for (const auto& player : players_) {
      const Pose2 pose = Pose2::from(player->loop->torso_in_world());
      const auto& state = player->robot->core().state();
      trace_row("robot", {player->who.robot, std::to_string(pose.position.x()),
                          std::to_string(pose.position.y()), std::to_string(pose.heading),
                          std::string(to_string(player->loop->core().motion_state().mode)),
                          std::to_string(static_cast<int>(state.role)),
                          std::string(to_string(state.phase)), state.reason.code});
    }
  }

  const ScenarioOptions& options_;
  std::shared_ptr<sim::World> world_;
  std::vector<std::unique_ptr<Player>> players_;
  std::unique_ptr<referee::RefereeCore> referee_;
  double next_referee_ = 0;
  double next_tell_ = 0;
  Tally tally_;
  std::string trace_;
};

std::vector<RunResult> run_match(const PerceptionFactory& perception,
                                 const ScenarioOptions& options, uint64_t seed) {
  Match match(options, perception, seed);
  RunResult result;
  match.play(result);
  return {result};
}

}  // namespace

Scenario match_scenario(bool is_rendered, const PerceptionFactory& perception) {
  return with_perception(
      {"match",
       "Two teams (--teams) play by themselves, --duration (300 s) in two halves",
       {{"goals", "1"},
        {"outs", "1"},
        {"kicks", "1"},
        {"falls", "1"},
        {"upright_ratio", "1"},
        {"penalties", "1"},
        {"longest_stuck_s", "s"}},
       std::bind_front(run_match, perception)},
      is_rendered);
}

}  // namespace nao::trial
