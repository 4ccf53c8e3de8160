#include "test/daemons/play/toy_world.h"

#include <algorithm>
#include <cmath>

namespace nao::play {
namespace {

using Eigen::Vector2d;

constexpr double kActionTime = 2.0;
constexpr double kDeceleration = 0.3;

PlayConstants make_toy_constants() {
  PlayConstants constants;
  constants.field = {9, 6, 1.5, 0.5, {0.6, 2.2}, 0.75, 1.65};
  constants.walk_limits = {0.3, 0.2, 0.2, 2};
  constants.kick = KickPlace{{0.18, 0.05}, {0.05, 0.025}};
  constants.parameters = PlayParameters::load("");
  constants.actions = {"kick-left", "kick-right", "block", "dive-left", "dive-right"};
  return constants;
}

}  // namespace

ToyWorld::ToyWorld()
    : core(make_toy_constants(), {-2, 2, -0.6, 0.5}, {"Yaw", "Pitch"}, "play.1", 1000),
      constants(make_toy_constants()) {}

void ToyWorld::command(Behavior behavior) {
  commanded_ = behavior;
  ++command_id_;
  last_command_ = -1e9;
}

// Eyes at 0.45 m: one camera straight ahead, one 0.7 rad below.
RobotView ToyWorld::view() const {
  RobotView view;
  view.feet_in_odometry = view.torso_in_odometry = feet;
  view.head_yaw = head_yaw_;
  view.head_pitch = head_pitch_;
  view.cameras = {{"top", {0.05, 0, 0.45}, head_yaw_, head_pitch_},
                  {"bottom", {0.05, 0, 0.4}, head_yaw_, head_pitch_ + 0.7}};
  return view;
}

void ToyWorld::kick(bool is_left) {
  const Vector2d in_feet = feet.inverse() * ball;
  const double side = is_left ? 1 : -1;
  const Vector2d off = (in_feet - Vector2d(0.18, 0.05 * side)).cwiseAbs();
  if (off.x() > 0.06 || off.y() > 0.035) return;
  ball_velocity = 1.6 * feet.rotate(Vector2d::UnitX());
}

void ToyWorld::obey(const Command& command) {
  commands.push_back(command);
  if (const auto* velocity = std::get_if<WalkCommand>(&command.request)) {
    walk = *velocity;
    last_walk_ = time;
    return;
  }
  answers_.push_back({command.source, command.id, kind_of(command), ResultStatus::kAccepted});
  if (const auto* change = std::get_if<JointChangeCommand>(&command.request)) {
    head_yaw_ = change->joint_position[0];
    head_pitch_ = change->joint_position[1];
    answers_.push_back({command.source, command.id, kind_of(command), ResultStatus::kDone});
  } else if (std::holds_alternative<ActionCommand>(command.request) && !action_) {
    actions.push_back(std::get<ActionCommand>(command.request).action);
    action_ = command;
    action_end_ = time + kActionTime;
    walk = {};
  }
}

void ToyWorld::move() {
  if (time - last_walk_ > 0.5) walk = {};
  const auto& most = constants.walk_limits;
  feet.position += kPeriod * feet.rotate({std::clamp(walk.vx, -most.backward, most.forward),
                                          std::clamp(walk.vy, -most.sideways, most.sideways)});
  feet.heading = wrapped(feet.heading + kPeriod * walk.wz);
  const bool walks = walk.vx != 0 || walk.vy != 0 || walk.wz != 0;
  if (mode == Mode::kHolding || mode == Mode::kWalking || mode == Mode::kActing) {
    mode = action_ ? Mode::kActing : walks ? Mode::kWalking : Mode::kHolding;
  }
  if (action_ && time >= action_end_) {
    const std::string& name = std::get<ActionCommand>(action_->request).action;
    if (name.starts_with("kick")) kick(name == "kick-left");
    answers_.push_back({action_->source, action_->id, CommandKind::kAction, ResultStatus::kDone});
    action_.reset();
  }
  ball += kPeriod * ball_velocity;
  const double speed = ball_velocity.norm();
  ball_velocity *= speed > kDeceleration * kPeriod ? 1 - kDeceleration * kPeriod / speed : 0;
  // The net.
  if (ball.x() > 4.9) ball_velocity.setZero();
  least_distance = std::min(least_distance, (ball - feet.position).norm());
}

void ToyWorld::step() {
  time += kPeriod;
  PlayInput input;
  input.now = input.time = time;
  if (commanded_ != Behavior::kNone && time - last_command_ >= 0.5) {
    last_command_ = time;
    input.requests.push_back({"test", command_id_, {commanded_}});
  }
  input.results = std::exchange(answers_, {});
  input.other_command = std::exchange(other_command, std::nullopt);
  input.mode = mode;
  input.needs_help = needs_help;
  input.match = match;
  input.vision.robots = robots;
  if (has_robot) input.robot = view();
  if (has_images) {
    input.vision.time = time;
    input.vision.image_status = image_status;
    const Vector2d in_feet = feet.inverse() * ball;
    const double bearing = wrapped(std::atan2(in_feet.y(), in_feet.x()) - head_yaw_);
    if (is_ball_visible && std::abs(bearing) < 0.5 && in_feet.norm() < sight) {
      seen_ = Ball{ball, ball_velocity, time, ball_velocity.norm() > 0.05};
    }
  }
  input.vision.ball = seen_;
  const PlayOutput output = core.step(input);
  for (const Command& each : output.commands) obey(each);
  for (const CommandResult& result : output.results) {
    if (results.empty() || results.back().status != result.status ||
        results.back().id != result.id) {
      results.push_back(result);
    }
  }
  if (!output.camera.empty() && (cameras.empty() || cameras.back() != output.camera)) {
    cameras.push_back(output.camera);
  }
  const PlayPhase phase = core.state().phase;
  if (phases.empty() || phases.back() != phase) phases.push_back(phase);
  move();
}

double ToyWorld::run(double timeout) {
  const double start = time;
  do {
    step();
  } while (core.is_active() && time - start < timeout);
  // An ended behavior is not restarted.
  stop_commanding();
  return time - start;
}

}  // namespace nao::play
