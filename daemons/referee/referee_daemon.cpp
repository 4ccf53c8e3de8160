#include "daemons/referee/referee_daemon.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <naolcm/match_command_t.hpp>
#include <random>
#include <utility>

#include "common/bus.h"
#include "common/channels.h"
#include "common/error.h"
#include "common/event_loop.h"
#include "common/logger.h"
#include "common/output_file.h"
#include "common/text_file.h"
#include "daemons/referee/match_file.h"
#include "daemons/referee/places.h"
#include "messages/command_sender.h"
#include "messages/result_message.h"
#include "robot_model/robot_model.h"

namespace nao::referee {
namespace {

const char* const kProgram = "nao-referee";
/** Robot time between two steps of the core, s. */
constexpr double kStepPeriod = 0.05;
/** s. */
constexpr double kStatusPeriod = 1;
/** Validity of a play_state_t, s: many of its periods. */
constexpr double kPlayTimeout = 2;
/** Time without the truth after which the simulator counts as gone, s. */
constexpr double kTruthTimeout = 2;
/** Time between two messages of a robot to the GameController, s (SPL rules, "GameController": one
 * to four a second). */
constexpr double kReturnPeriod = 0.5;
/** Period at which the match is saved, s. */
constexpr double kSavePeriod = 1;
/** A torso that leans by more than this, rad, is not on its feet. Chosen: a kick leans by 0.3. */
constexpr double kMaxTilt = 0.8;
/** The name of the ball as a body. */
const char* const kBall = "ball";

std::vector<MatchPlayer> players_of(const std::vector<RobotOption>& robots) {
  std::vector<MatchPlayer> players;
  for (const RobotOption& robot : robots) {
    if (!robot.team) {
      throw ConfigError("robot " + robot.name + " has no team; name it " + robot.name +
                        ":MODEL:TEAM:NUMBER");
    }
    MatchPlayer player;
    player.robot = robot.name;
    player.team = *robot.team;
    player.number = robot.number;
    players.push_back(player);
  }
  return players;
}

std::map<std::string, std::string> ready_postures_of(const std::vector<RobotOption>& robots) {
  std::map<std::string, std::string> postures;
  for (const RobotOption& robot : robots) {
    const auto model = RobotModel::find(robot.model);
    postures[robot.name] = model.ready_posture().name;
  }
  return postures;
}

int64_t random_id() {
  // 53 bits, which even JSON readers that know only double preserve.
  std::random_device device;
  return std::uniform_int_distribution<int64_t>(1, int64_t{1} << 53)(device);
}

/** Source of this process's world commands. */
std::string own_source() {
  return "referee." + std::to_string(getpid());
}

/** Angle between the torso's z axis and the vertical, rad. */
double tilt_of(const naolcm::robot_truth_t& robot) {
  const double(&q)[4] = robot.orientation_torso_in_world;
  return std::acos(std::clamp(1 - 2 * (q[1] * q[1] + q[2] * q[2]), -1.0, 1.0));
}

/** The robot of a body's name such as "NAO/LFoot". */
std::string robot_of(const std::string& body) {
  const size_t slash = body.find('/');
  return slash == std::string::npos ? "" : body.substr(0, slash);
}

}  // namespace

RefereeInput to_input(const naolcm::world_truth_t& truth, const std::vector<MatchPlayer>& players) {
  RefereeInput input;
  input.time = 1e-6 * static_cast<double>(truth.utime);
  input.ball = Eigen::Vector3d(truth.position_ball_in_world);
  for (const naolcm::robot_truth_t& robot : truth.robots) {
    const bool is_player = std::any_of(players.begin(), players.end(), [&](const auto& player) {
      return player.robot == robot.robot;
    });
    if (!is_player) continue;
    RobotSighting sighting;
    sighting.name = robot.robot;
    sighting.position = Eigen::Vector3d(robot.position_torso_in_world).head<2>();
    sighting.is_upright = tilt_of(robot) < kMaxTilt;
    for (const naolcm::contact_t& contact : truth.contacts) {
      sighting.touches_ball |=
          (contact.body_a == kBall && robot_of(contact.body_b) == robot.robot) ||
          (contact.body_b == kBall && robot_of(contact.body_a) == robot.robot);
    }
    input.robots.push_back(sighting);
  }
  return input;
}

void update(RobotKnowledge& knowledge, const naolcm::vision_state_t& vision) {
  knowledge.pose.reset();
  if (vision.has_field_pose) {
    const double(&pose)[3] = vision.torso_in_field;
    knowledge.pose = Pose2{{pose[0], pose[1]}, pose[2]};
  }
  double confidence = 0;
  for (const naolcm::detection_t& detection : vision.detections) {
    const double(&position)[2] = detection.position_in_heading;
    const bool is_better = detection.kind == naolcm::detection_t::KIND_BALL &&
                           detection.confidence > confidence && std::isfinite(position[0]) &&
                           std::isfinite(position[1]);
    if (!is_better) continue;
    confidence = detection.confidence;
    knowledge.ball = {position[0], position[1]};
    knowledge.ball_time = 1e-6 * static_cast<double>(vision.utime);
  }
}

GameControllerReturn to_return(const MatchPlayer& player, const RobotSighting& robot,
                               const RobotKnowledge& knowledge, double now) {
  GameControllerReturn answer;
  answer.player_number = player.number;
  answer.is_fallen = !robot.is_upright;
  if (knowledge.ball) {
    answer.ball_age = now - knowledge.ball_time;
    answer.ball = {knowledge.ball->x(), knowledge.ball->y()};
  }
  if (knowledge.pose)
    answer.pose = {knowledge.pose->position.x(), knowledge.pose->position.y(),
                   knowledge.pose->heading};
  return answer;
}

RefereeDaemon::RefereeDaemon(Bus& bus, const RefereeOptions& options, std::function<double()> clock)
    : bus_(bus),
      options_(options),
      clock_(std::move(clock)),
      status_(bus, kProgram),
      second_process_(bus, kProgram, "", clock_),
      commands_(bus, RobotChannels(options.robots.empty() ? "NAO" : options.robots.front().name)),
      ready_postures_(ready_postures_of(options.robots)),
      // Numbers that no earlier referee with the same process id has used.
      last_id_(wall_utime()) {
  make_referee();
  if (!options_.state_file.empty() && std::filesystem::exists(options_.state_file)) {
    const MatchState kept = match_from_json(read_file(options_.state_file));
    referee_->restore(kept);
    logger::info("continues a match: {}, {}:{}, {:.0f} s left of half {}", to_string(kept.phase),
                 kept.score[0], kept.score[1], kept.time_left, kept.half);
  }
  subscribe();
  publish_status(clock_());
}

void RefereeDaemon::make_referee() {
  const std::vector<MatchPlayer> players = players_of(options_.robots);
  const SceneFile scene = SceneFile::find(options_.scene);
  if (!options_.game_controller_port) {
    referee_ = std::make_unique<RefereeCore>(players, scene, options_.rules, random_id());
    return;
  }
  auto follower =
      std::make_unique<GameControllerReferee>(players, scene, options_.team_numbers, random_id());
  game_controller_.emplace(*options_.game_controller_port, options_.return_port, *follower, clock_);
  referee_ = std::move(follower);
}

void RefereeDaemon::answer_game_controller() {
  for (const MatchPlayer& player : referee_->state().players) {
    const RobotSighting* robot = find_robot(last_input_, player.robot);
    if (robot == nullptr) continue;
    game_controller_->send(
        to_return(player, *robot, knowledge_[player.robot], 1e-6 * static_cast<double>(utime_)),
        player.team);
  }
}

void RefereeDaemon::subscribe() {
  bus_.subscribe<naolcm::world_truth_t>(kWorldTruthChannel, Bus::Queue::kAll,
                                        [this](const auto& truth) { handle(truth); });
  bus_.subscribe<naolcm::match_command_t>(kMatchCommandChannel, Bus::Queue::kAll,
                                          [this](const auto& message) { handle(message); });
  for (const RobotOption& robot : options_.robots) {
    const auto keep = [this, name = robot.name](const auto& state) {
      plays_[name] = {state, clock_()};
    };
    bus_.subscribe<naolcm::play_state_t>(RobotChannels(robot.name).play_state, Bus::Queue::kLatest,
                                         keep);
    if (!game_controller_) continue;
    bus_.subscribe<naolcm::vision_state_t>(
        RobotChannels(robot.name).vision_state, Bus::Queue::kLatest,
        [this, name = robot.name](const auto& state) { update(knowledge_[name], state); });
  }
}

void RefereeDaemon::attach(EventLoop& loop) {
  loop.on_readable(bus_.descriptor(), [this] { bus_.handle(); });
  loop.every(kStatePeriod, [this] { publish_state(); });
  loop.every(kRepeatPeriod, [this] { send_placement(); });
  if (game_controller_) {
    loop.on_readable(game_controller_->descriptor(), [this] { game_controller_->receive(); });
    loop.every(kReturnPeriod, [this] { answer_game_controller(); });
  }
  loop.every_aligned(kStatusPeriod, [this] { publish_status(clock_()); });
}

void RefereeDaemon::handle(const naolcm::world_truth_t& truth) {
  const double now = clock_();
  last_truth_ = now;
  utime_ = truth.utime;
  if (!placements_.empty() && truth.last_command_source == own_source() &&
      truth.last_command_id == placements_.front().command_id) {
    if (!truth.last_command_error.empty()) {
      logger::warn("the simulator did not {}: {}", placements_.front().command,
                   truth.last_command_error);
    }
    placements_.pop_front();
    send_placement();
  }
  RefereeInput input = to_input(truth, referee_->state().players);
  for (const RobotSighting& robot : input.robots) touches_[robot.name] |= robot.touches_ball;
  // A new simulator begins at 0.
  if (input.time >= next_step_ - 2 * kStepPeriod && input.time < next_step_) return;
  next_step_ = input.time + kStepPeriod - 1e-6;
  for (RobotSighting& robot : input.robots) {
    robot.touches_ball = std::exchange(touches_[robot.name], false);
    const auto play = plays_.find(robot.name);
    if (play == plays_.end() || now - play->second.received > kPlayTimeout) continue;
    robot.is_autonomous = play->second.state.behavior == naolcm::play_state_t::BEHAVIOR_AUTO;
    robot.role = static_cast<PlayRole>(std::clamp<int>(play->second.state.role, 0, 3));
  }
  last_input_ = input;
  const bool are_all_there = input.robots.size() == referee_->state().players.size();
  if (options_.starts_by_itself && are_all_there &&
      referee_->state().phase == MatchPhase::kInitial) {
    (void)referee_->overrule({MatchOperation::kStart, 0, ""});
  }
  const RefereeOutput output = referee_->step(input);
  for (const Placement& placement : output.placements) put(placement);
  write_files(output.events);
  if (!output.events.empty()) publish_state();
}

void RefereeDaemon::put(const Placement& placement) {
  naolcm::world_command_t command{};
  command.command_id = ++last_id_;
  command.command = placement.robot.empty() ? "place-ball" : "place-robot";
  command.robot = placement.robot;
  command.position_in_world[0] = placement.pose.position.x();
  command.position_in_world[1] = placement.pose.position.y();
  if (!placement.robot.empty()) {
    command.posture = ready_postures_[placement.robot];
    command.orientation_in_world[0] = std::cos(0.5 * placement.pose.heading);
    command.orientation_in_world[3] = std::sin(0.5 * placement.pose.heading);
  }
  placements_.push_back(command);
  if (placements_.size() == 1) send_placement();
}

void RefereeDaemon::send_placement() {
  if (placements_.empty()) return;
  const naolcm::world_command_t& next = placements_.front();
  commands_.publish(kWorldCommandChannel, next, own_source(), next.command_id);
}

void RefereeDaemon::write_files(const std::vector<MatchEvent>& events) {
  for (const MatchEvent& event : events) {
    const MatchState& state = referee_->state();
    logger::info("{}{}{}, {}:{}", to_string(event.kind),
                 event.team >= 0 ? " of team " + std::to_string(event.team) : "",
                 event.robot.empty() ? "" : ", " + event.robot, state.score[0], state.score[1]);
    if (options_.events_file.empty()) continue;
    std::ofstream stream(options_.events_file, std::ios::app);
    stream << event_to_json(event, state) << "\n";
    const bool is_written = static_cast<bool>(stream.flush());
    note_file(options_.events_file, is_written ? ""
                                               : "cannot write " + options_.events_file.string() +
                                                     ": " + std::strerror(errno));
  }
  const double now = clock_();
  if (options_.state_file.empty() || (events.empty() && now - last_saved_ < kSavePeriod)) return;
  last_saved_ = now;
  try {
    replace_file(options_.state_file, to_json(referee_->state()));
    note_file(options_.state_file, "");
  } catch (const Error& error) {
    note_file(options_.state_file, error.what());
  }
}

void RefereeDaemon::note_file(const std::filesystem::path& file, const std::string& fault) {
  std::string& last = file_faults_[file.string()];
  if (!fault.empty() && fault != last) {
    logger::error("{}; the match continues", fault);
  }
  last = fault;
}

void RefereeDaemon::handle(const naolcm::match_command_t& message) {
  const auto answer = [&](const CommandResult& result) {
    bus_.publish(kMatchCommandResultChannel, to_message(result, utime_));
  };
  CommandResult result{
      message.source, message.command_id, CommandKind::kMatch, ResultStatus::kRefused, {}};
  if (const auto fault = check_sender(message.source, message.command_id)) {
    result.reason = *fault;
    answer(result);
    return;
  }
  if (const CommandResult* known = ledger_.find(message.source, message.command_id)) {
    answer(*known);
    return;
  }
  const MatchCommand command = to_match_command(message);
  if (const auto fault = referee_->overrule(command)) {
    result.reason = *fault;
  } else {
    result.status = ResultStatus::kDone;
    logger::info("{}: {}", quoted(message.source), to_string(command.operation));
  }
  ledger_.note(result);
  answer(result);
  publish_state();
}

void RefereeDaemon::publish_state() {
  bus_.publish(kMatchStateChannel, to_message(referee_->state(), utime_, ++sequence_));
}

void RefereeDaemon::publish_status(double now) {
  status_.tick(now);
  const MatchState& state = referee_->state();
  if (const std::string second = second_process_.describe(); !second.empty()) {
    status_.set_state("ready", second);
  } else if (now - last_truth_ > kTruthTimeout) {
    status_.set_state("waiting", "for nao-sim");
  } else if (game_controller_ && game_controller_->is_silent()) {
    // Ready: the GameController is often started, or sends, only later.
    status_.set_state("ready", "waits for the GameController at UDP port " +
                                   std::to_string(game_controller_port()));
  } else {
    std::string detail = std::string(to_string(state.phase)) + ", " +
                         std::to_string(state.score[0]) + ":" + std::to_string(state.score[1]);
    if (const std::string ignored = game_controller_ ? game_controller_->ignored() : "";
        !ignored.empty()) {
      detail += "; ignores a second GameController at " + ignored;
    }
    for (const auto& [file, fault] : file_faults_) {
      if (!fault.empty()) detail += "; " + fault;
    }
    status_.set_state("ready", detail);
  }
  status_.publish({{"goals_team0", static_cast<double>(state.score[0])},
                   {"goals_team1", static_cast<double>(state.score[1])},
                   {"time_left_s", state.time_left}});
}

}  // namespace nao::referee
