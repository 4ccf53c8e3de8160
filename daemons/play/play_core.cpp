#include "daemons/play/play_core.h"

#include <algorithm>
#include <array>
#include <utility>

#include "daemons/play/auto_player.h"
#include "daemons/play/keeper.h"
#include "daemons/play/striker.h"

namespace nao::play {
namespace {

/** Time without an image after which the robot stands, s; and a longer time after which the
 * behavior fails. Chosen: a busy host analyses 4 images a second, and a camera starts within 2 s.
 */
constexpr double kVisionTimeout = 1.5;
constexpr double kVisionGivenUp = 15;
/** Names of vision_state_t's IMAGE_STATUS_*. */
constexpr std::array kImageStatusNames = {"ok", "covered", "overexposed", "frozen", "inverted"};

bool has_fallen(Mode mode) {
  return mode == Mode::kFalling || mode == Mode::kFallen || mode == Mode::kGettingUp;
}

Reason reason_of_fall(Mode mode) {
  if (mode == Mode::kFalling) return {"robot-falling"};
  if (mode == Mode::kGettingUp) return {"robot-getting-up"};
  return {"robot-fallen"};
}

}  // namespace

PlayCore::PlayCore(const PlayConstants& constants, const HeadLimits& head_limits,
                   std::vector<std::string> head_joints, const std::string& source,
                   int64_t first_id)
    : constants_(constants),
      head_(head_limits, constants.parameters.head_control),
      motion_(source, first_id, std::move(head_joints)),
      robots_(constants.parameters.robot_memory) {}

PlayOutput PlayCore::step(const PlayInput& input) {
  PlayOutput output;
  output.results = reminder_.due(last_step_ > 0 ? input.now - last_step_ : 0);
  last_step_ = input.now;
  if (input.vision.field_in_odometry) last_field_ = input.vision.field_in_odometry;
  if (input.vision.time != last_image_) robots_.add(input.vision.robots, input.time);
  last_image_ = input.vision.time;
  robots_.forget(input.time);
  for (const CommandResult& result : input.results) motion_.handle_result(result, input.time);
  // This comes before the requests: another sender's command has ended the old behavior, not the
  // new one.
  if (behavior_) end_if_necessary(input, output);
  for (const PlayRequest& request : input.requests) take(request, input, output);
  if (behavior_) run(input, output);
  for (Command& command : motion_.step(input.time)) output.commands.push_back(std::move(command));
  return output;
}

void PlayCore::report(const PlayRequest& request, ResultStatus status, const Reason& reason,
                      PlayOutput& output) {
  const CommandResult result{request.source, request.id, CommandKind::kPlay, status, reason};
  ledger_.note(result);
  reminder_.note(result);
  output.results.push_back(result);
}

void PlayCore::take(const PlayRequest& request, const PlayInput& input, PlayOutput& output) {
  if (auto fault = check_sender(request.source, request.id)) {
    output.results.push_back(
        {request.source, request.id, CommandKind::kPlay, ResultStatus::kRefused, *fault});
    return;
  }
  if (const CommandResult* known = ledger_.find(request.source, request.id)) {
    output.results.push_back(*known);
    if (behavior_ && request.source == request_.source && request.id == request_.id) {
      last_command_ = input.now;
    }
    return;
  }
  if (auto fault = check(request.command)) {
    report(request, ResultStatus::kRefused, *fault, output);
    return;
  }
  if (request.command.behavior == Behavior::kNone) {
    end(ResultStatus::kInterrupted, Reason("play-stopped"), true, input.time, output);
    report(request, ResultStatus::kDone, {}, output);
    state_ = {};
    return;
  }
  // The robot itself goes on, whatever becomes of the sender.
  if (request.command.behavior == Behavior::kAuto && input.waits_for_release) {
    end(ResultStatus::kInterrupted, Reason("play-stopped"), true, input.time, output);
    report(request, ResultStatus::kDone, {}, output);
    output.is_released = true;
    return;
  }
  begin(request, input, output);
}

void PlayCore::begin(const PlayRequest& request, const PlayInput& input, PlayOutput& output) {
  if (!input.robot || input.mode == Mode::kNoRobot) {
    report(request, ResultStatus::kRefused, Reason("no-robot"), output);
    return;
  }
  std::unique_ptr<BehaviorMachine> behavior = make_behavior(request.command);
  if (!behavior) {
    report(request, ResultStatus::kRefused,
           Reason("behavior-unavailable", {std::string(to_string(request.command.behavior))}),
           output);
    return;
  }
  // The robot need not stand between two behaviors.
  end(ResultStatus::kInterrupted, Reason("replaced", {to_string(CommandKind::kPlay)}), false,
      input.time, output);
  report(request, ResultStatus::kAccepted, {}, output);
  request_ = request;
  behavior_ = std::move(behavior);
  last_command_ = input.now;
  waits_since_.reset();
  state_ = {};
  state_.behavior = request.command.behavior;
  state_.role = request.command.role;
  state_.command_source = request.source;
  state_.command_id = request.id;
}

std::unique_ptr<BehaviorMachine> PlayCore::make_behavior(const PlayCommand& command) const {
  std::optional<Eigen::Vector2d> target;
  if (command.target_in_odometry) {
    target.emplace((*command.target_in_odometry)[0], (*command.target_in_odometry)[1]);
  }
  const bool kicks = constants_.kick && !constants_.actions.kick_left.empty() &&
                     !constants_.actions.kick_right.empty();
  switch (command.behavior) {
    case Behavior::kGoToBall:
      return std::make_unique<Striker>(constants_, Striker::Task::kGoToBall, std::nullopt);
    case Behavior::kKick:
      if (!kicks) return nullptr;
      return std::make_unique<Striker>(constants_, Striker::Task::kKick, target);
    case Behavior::kDribble:
      return std::make_unique<Striker>(constants_, Striker::Task::kDribble, target);
    case Behavior::kScore:
      if (!kicks) return nullptr;
      return std::make_unique<Striker>(constants_, Striker::Task::kScore, std::nullopt);
    case Behavior::kKeepGoal:
      return std::make_unique<Keeper>(constants_);
    case Behavior::kAuto:
      if (!kicks) return nullptr;
      return std::make_unique<AutoPlayer>(constants_);
    default:
      return nullptr;
  }
}

void PlayCore::end(ResultStatus status, const Reason& reason, bool stops, double time,
                   PlayOutput& output) {
  if (!behavior_) return;
  behavior_.reset();
  if (stops) motion_.stop(time);
  report(request_, status, reason, output);
  // The behavior still learns how the action ended.
  state_.phase = status == ResultStatus::kDone ? PlayPhase::kDone : PlayPhase::kIdle;
  state_.behavior = Behavior::kNone;
  state_.role = PlayRole::kNone;
  state_.command_source.clear();
  state_.command_id = 0;
  state_.target_in_field.reset();
  state_.reason = reason;
}

bool PlayCore::end_if_necessary(const PlayInput& input, PlayOutput& output) {
  if (input.other_command) {
    motion_.abandon();
    end(ResultStatus::kInterrupted, Reason("replaced", {to_string(*input.other_command)}), false,
        input.time, output);
    return true;
  }
  if (input.now - last_command_ > kCommandTimeout) {
    end(ResultStatus::kInterrupted, Reason("play-command-timeout", {to_argument(kCommandTimeout)}),
        true, input.time, output);
    return true;
  }
  if (!input.robot || input.mode == Mode::kNoRobot) {
    motion_.abandon();
    end(ResultStatus::kFailed, Reason("no-robot"), false, input.time, output);
    return true;
  }
  if (input.needs_help) {
    motion_.abandon();
    end(ResultStatus::kFailed, Reason("robot-fallen"), false, input.time, output);
    return true;
  }
  return false;
}

std::optional<Reason> PlayCore::find_obstacle(const PlayInput& input) {
  if (input.time - input.vision.time > kVisionTimeout) return Reason("vision-unavailable");
  const auto status = static_cast<size_t>(input.vision.image_status);
  if (status == 0) return std::nullopt;
  return Reason("image-unusable",
                {status < kImageStatusNames.size() ? kImageStatusNames[status] : "unknown"});
}

void PlayCore::run(const PlayInput& input, PlayOutput& output) {
  state_.reason = {};
  state_.target_in_field.reset();
  // A dive falls on purpose, and its action includes getting up.
  if (has_fallen(input.mode) && !motion_.is_performing()) {
    motion_.abandon();
    behavior_->restart();
    state_.phase = PlayPhase::kRecover;
    state_.reason = reason_of_fall(input.mode);
    return;
  }
  Situation situation;
  situation.time = input.time;
  situation.robot = *input.robot;
  situation.ball = input.vision.ball;
  situation.field_in_odometry = field_in_odometry();
  situation.is_still = input.mode == Mode::kHolding || input.mode == Mode::kMoving;
  situation.is_performing = motion_.is_performing();
  situation.match = input.match;
  situation.robots = find_robots(input);
  const auto obstacle = find_obstacle(input);
  if (!obstacle || situation.is_performing) {
    waits_since_.reset();
    situation.ended = motion_.take_ended();
    execute(behavior_->step(situation), situation, input, output);
    return;
  }
  // Without images, the robot stands, requests them, and continues when they arrive.
  if (!waits_since_) waits_since_ = input.time;
  motion_.walk({}, input.time);
  state_.phase = PlayPhase::kSearch;
  state_.reason = *obstacle;
  if (!situation.robot.cameras.empty()) output.camera = situation.robot.cameras.front().name;
  if (input.time - *waits_since_ > kVisionGivenUp) {
    end(ResultStatus::kFailed, *obstacle, true, input.time, output);
  }
}

void PlayCore::execute(const Decision& decision, const Situation& situation, const PlayInput& input,
                       PlayOutput& output) {
  state_.phase = decision.phase;
  state_.reason = decision.reason;
  if (decision.role) state_.role = *decision.role;
  if (decision.target) {
    state_.target_in_field = field_in_odometry().inverse() * *decision.target;
  }
  if (const auto head = head_.look(decision.gaze, *input.robot)) {
    output.camera = head->camera;
    if (!decision.action) motion_.turn_head({head->yaw, head->pitch}, input.time);
  }
  if (decision.is_done) {
    end(decision.has_failed ? ResultStatus::kFailed : ResultStatus::kDone, decision.reason, true,
        input.time, output);
    return;
  }
  if (motion_.is_performing()) return;
  if (decision.action) {
    if (decision.walks_on) motion_.walk(decision.walk, input.time);
    motion_.perform(*decision.action, decision.walks_on, input.time);
  } else {
    motion_.walk(keep_clear(decision.walk, situation.robots, input.robot->feet_in_odometry,
                            constants_.parameters.robot_memory),
                 input.time);
  }
}

std::vector<Eigen::Vector2d> PlayCore::find_robots(const PlayInput& input) const {
  std::vector<Eigen::Vector2d> result = robots_.positions();
  if (!input.match) return result;
  for (const Teammate& mate : input.match->teammates) {
    if (mate.seen.position) result.push_back(field_in_odometry() * *mate.seen.position);
  }
  return result;
}

// Until the robot is localised, it is assumed to have started where the options say.
Pose2 PlayCore::field_in_odometry() const {
  return last_field_ ? *last_field_ : constants_.start_in_field.inverse();
}

}  // namespace nao::play
