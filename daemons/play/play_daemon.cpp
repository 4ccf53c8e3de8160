#include "daemons/play/play_daemon.h"

#include <unistd.h>

#include <naolcm/action_command_t.hpp>
#include <naolcm/command_result_t.hpp>
#include <naolcm/joint_change_command_t.hpp>
#include <naolcm/match_state_t.hpp>
#include <naolcm/motion_state_t.hpp>
#include <naolcm/move_to_command_t.hpp>
#include <naolcm/play_command_t.hpp>
#include <naolcm/posture_command_t.hpp>
#include <naolcm/stop_command_t.hpp>
#include <naolcm/walk_command_t.hpp>
#include <utility>

#include "common/bus.h"
#include "common/event_loop.h"
#include "common/logger.h"
#include "common/robot_option.h"
#include "common/wall_clock.h"
#include "messages/result_message.h"

namespace nao::play {
namespace {

const char* const kProgram = "nao-play";
/** s. */
constexpr double kStatusPeriod = 1;
/** Time without a message of nao-motion after which there is no robot, s: robot_state_t. */
constexpr double kRobotTimeout = 0.5;
/** Time without match messages after which a match is over, s: ten of nao-referee's messages. */
constexpr double kMatchTimeout = 2;

PlayConstants make_constants(const RobotModel& model, const PlayOptions& options) {
  PlayConstants constants = load_constants(model, options.scene);
  constants.start_in_field = options.start_in_field;
  return constants;
}

CommandResult read_result(const naolcm::command_result_t& message) {
  CommandResult result{message.source, message.command_id,
                       static_cast<CommandKind>(message.command_kind),
                       static_cast<ResultStatus>(message.status)};
  result.reason.code = message.reason_code;
  result.reason.arguments = message.reason_arguments;
  return result;
}

}  // namespace

PlayDaemon::PlayDaemon(Bus& bus, const RobotModel& model, const PlayOptions& options,
                       std::function<double()> clock)
    : bus_(bus),
      model_(model),
      clock_(std::move(clock)),
      channels_(options.robot),
      status_(bus, kProgram, options.robot),
      commands_(bus_, channels_),
      viewer_(model),
      source_("play." + std::to_string(getpid())),
      // Numbers that no earlier process with the same id has used.
      core_(make_constants(model, options), viewer_.head_limits(), viewer_.head_joints(), source_,
            wall_utime()),
      robot_(options.robot),
      autonomy_(options.is_autonomous, wall_utime()) {
  subscribe();
  publish_status(clock_());
}

void PlayDaemon::subscribe() {
  bus_.subscribe<naolcm::play_command_t>(
      channels_.play_command, Bus::Queue::kAll, [this](const auto& message) {
        const PlayCommand command = to_play_command(message);
        input_.requests.push_back({message.source, message.command_id, command});
        const bool is_other = message.source != source_ && command.behavior != Behavior::kAuto;
        if (is_other) autonomy_.note_other_command(clock_());
      });
  bus_.subscribe<naolcm::robot_state_t>(
      channels_.robot_state, Bus::Queue::kLatest, [this](const auto& message) {
        const RobotPose pose = decode_pose(model_, message);
        input_.robot = viewer_.look(pose.torso_in_odometry, pose.position);
        torso_.add(message.utime, input_.robot->torso_in_odometry);
        utime_ = message.utime;
        last_robot_ = clock_();
      });
  bus_.subscribe<naolcm::motion_state_t>(channels_.motion_state, Bus::Queue::kLatest,
                                         [this](const auto& message) {
                                           input_.mode = static_cast<Mode>(message.mode);
                                           input_.needs_help = message.needs_help != 0;
                                           last_motion_ = clock_();
                                         });
  bus_.subscribe<naolcm::vision_state_t>(
      channels_.vision_state, Bus::Queue::kLatest,
      [this](const auto& message) { input_.vision = decode_vision(message, torso_); });
  bus_.subscribe<naolcm::match_state_t>(kMatchStateChannel, Bus::Queue::kLatest,
                                        [this](const auto& message) {
                                          match_ = to_match_state(message);
                                          last_match_ = clock_();
                                          watch_teammates(*match_);
                                        });
  bus_.subscribe<naolcm::command_result_t>(channels_.command_result, Bus::Queue::kAll,
                                           [this](const auto& message) {
                                             if (message.source == source_)
                                               input_.results.push_back(read_result(message));
                                           });
  watch_commands<naolcm::walk_command_t>(channels_.walk_command, CommandKind::kWalk);
  watch_commands<naolcm::move_to_command_t>(channels_.move_to_command, CommandKind::kMoveTo);
  watch_commands<naolcm::posture_command_t>(channels_.posture_command, CommandKind::kPosture);
  watch_commands<naolcm::joint_change_command_t>(channels_.joint_change_command,
                                                 CommandKind::kJointChange);
  watch_commands<naolcm::action_command_t>(channels_.action_command, CommandKind::kAction);
  watch_commands<naolcm::stop_command_t>(channels_.stop_command, CommandKind::kStop);
}

template <class Message>
void PlayDaemon::watch_commands(const std::string& channel, CommandKind kind) {
  bus_.subscribe<Message>(channel, Bus::Queue::kAll, [this, kind](const Message& message) {
    if (message.source == source_) return;
    input_.other_command = kind;
    autonomy_.note_other_command(clock_());
  });
}

// Subscriptions end with the program: a robot that has left the match is ignored.
void PlayDaemon::watch_teammates(const MatchState& state) {
  const MatchPlayer* own = find_player(state, robot_);
  if (own == nullptr) return;
  for (const MatchPlayer& player : state.players) {
    if (player.team != own->team || player.robot == robot_) continue;
    // It becomes part of a channel's name.
    if (const std::string fault = fault_of_robot_name(player.robot); !fault.empty()) {
      throw MessageError(fault);
    }
    if (!watched_.insert(player.robot).second) continue;
    bus_.subscribe<naolcm::vision_state_t>(
        RobotChannels(player.robot).vision_state, Bus::Queue::kLatest,
        [this, name = player.robot](const auto& message) {
          const TeamObservation seen = decode_observation(message);
          // An image without the ball does not cancel the previous sighting.
          TeamObservation& kept = teammates_[name];
          const bool keeps_ball = !seen.ball && seen.time - kept.time < 1;
          const auto ball = keeps_ball ? kept.ball : seen.ball;
          kept = seen;
          kept.ball = ball;
        });
  }
}

void PlayDaemon::request_auto(double now) {
  AutonomyInput input;
  input.is_match_on = input_.match && input_.match->phase != MatchPhase::kInitial &&
                      input_.match->phase != MatchPhase::kFinished;
  input.has_robot = input_.robot.has_value();
  input.is_active = core_.is_active();
  input.is_own = core_.state().command_source == source_;
  const auto id = autonomy_.step(input, now);
  if (id) input_.requests.push_back({source_, *id, {Behavior::kAuto}});
}

void PlayDaemon::attach(EventLoop& loop) {
  loop.on_readable(bus_.descriptor(), [this] { bus_.handle(); });
  loop.every(kStepPeriod, [this] { step(clock_()); });
  loop.every(kStatePeriod, [this] { publish_state(); });
  loop.every_aligned(kStatusPeriod, [this] { publish_status(clock_()); });
}

void PlayDaemon::step(double now) {
  status_.tick(now);
  input_.now = now;
  input_.time = 1e-6 * static_cast<double>(utime_);
  if (now - last_robot_ > kRobotTimeout || now - last_motion_ > kRobotTimeout) {
    input_.robot.reset();
  }
  input_.match.reset();
  if (match_ && now - last_match_ < kMatchTimeout) {
    input_.match = view_match(*match_, robot_, input_.time, teammates_);
  }
  request_auto(now);
  input_.waits_for_release = autonomy_.waits_for_release();
  const PlayOutput output = core_.step(input_);
  if (output.is_released) {
    autonomy_.release();
    logger::info("released: plays by itself again");
  }
  input_.requests.clear();
  input_.results.clear();
  input_.other_command.reset();
  for (const Command& command : output.commands) commands_.publish(command);
  for (const CommandResult& result : output.results) {
    bus_.publish(channels_.command_result, to_message(result, utime_));
  }
  if (std::exchange(camera_, output.camera) != output.camera) publish_state();
}

void PlayDaemon::publish_state() {
  PlayState state = core_.state();
  if (!core_.is_active() && autonomy_.waits_for_release()) state.reason = Reason(kWaitsForRelease);
  naolcm::play_state_t message = encode_state(state, utime_);
  message.camera = camera_;
  bus_.publish(channels_.play_state, message);
}

void PlayDaemon::publish_status(double now) {
  status_.tick(now);
  std::string detail;
  if (core_.is_active()) {
    detail = std::string(to_string(core_.state().behavior)) + ", " +
             std::string(to_string(core_.state().phase));
  } else if (autonomy_.waits_for_release()) {
    detail = to_sentence(Reason(kWaitsForRelease));
  }
  status_.set_state("ready", detail);
  status_.publish({{"is_active", core_.is_active() ? 1.0 : 0.0}});
}

void PlayDaemon::shut_down(double now) {
  if (!core_.is_active()) return;
  PlayRequest request{source_, wall_utime(), {}};
  input_.requests = {request};
  step(now);
  // The bus may lose a message: the three zeros of an ended walk.
  for (int i = 1; i <= 3; ++i) {
    utime_ += 100000;
    step(now + 0.1 * i);
  }
}

}  // namespace nao::play
