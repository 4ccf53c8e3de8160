#include "daemons/play/motion_driver.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace nao::play {
namespace {

/** Time between two commands of a walk, s: twice the least rate of walk_command_t. */
constexpr double kWalkPeriod = 0.1;
/** Transmissions of zero velocity at the end of a walk, as the gateway does. */
constexpr int kNumZeros = 3;
/** Time between two transmissions of an action that was accepted, s: its result may have been lost.
 */
constexpr double kConfirmPeriod = 1;
/** Time after which an action without any answer has failed, s. */
constexpr double kAnswerTimeout = 1.5;
/** Least change of the head's angles that is commanded, rad, and least time between two, s. */
constexpr double kHeadStep = 0.03;
constexpr double kHeadPeriod = 0.12;
/** Fraction of the joints' maximum speed. Chosen: 1 rad in 0.4 s, without shaking the walk. */
constexpr double kHeadSpeed = 0.3;

bool is_zero(const WalkCommand& velocity) {
  return velocity.vx == 0 && velocity.vy == 0 && velocity.wz == 0;
}

}  // namespace

MotionDriver::Event MotionDriver::make_event(decltype(Command::request) request,
                                             double confirm_period, double time) {
  CommandRetry::Timing timing;
  timing.confirm_period = confirm_period;
  timing.answer_timeout = kAnswerTimeout;
  return {{source_, next_id_++, std::move(request)}, CommandRetry(timing, time)};
}

void MotionDriver::walk(const WalkCommand& velocity, double /*time*/) {
  velocity_ = velocity;
  if (is_zero(velocity)) {
    if (walk_id_ != 0) {
      num_zeros_left_ = kNumZeros;
      // At once.
      last_walk_sent_ = -1e9;
    }
    walk_id_ = 0;
    return;
  }
  num_zeros_left_ = 0;
  if (walk_id_ == 0) walk_id_ = last_walk_id_ = next_id_++;
}

void MotionDriver::perform(const ActionCommand& action, bool walks_on, double time) {
  if (!walks_on) {
    // No zeros are sent: the action replaces the walk.
    walk_id_ = 0;
    num_zeros_left_ = 0;
  }
  head_.reset();
  head_angles_.clear();
  ended_.reset();
  action_ = make_event(action, kConfirmPeriod, time);
}

void MotionDriver::turn_head(const std::vector<double>& angles, double time) {
  // During an action, the action controls the head.
  if (action_ || time - last_head_ < kHeadPeriod) return;
  double change = head_angles_.empty() ? 2 * kHeadStep : 0;
  for (size_t i = 0; i < head_angles_.size(); ++i) {
    change = std::max(change, std::abs(angles[i] - head_angles_[i]));
  }
  if (change < kHeadStep) return;
  last_head_ = time;
  head_angles_ = angles;
  JointChangeCommand command;
  command.speed = kHeadSpeed;
  for (size_t i = 0; i < head_joints_.size() && i < angles.size(); ++i) {
    if (head_joints_[i].empty()) continue;
    command.joint_names.push_back(head_joints_[i]);
    command.joint_position.push_back(angles[i]);
  }
  if (!command.joint_names.empty()) head_ = make_event(command, CommandRetry::kNever, time);
}

void MotionDriver::stop(double time) {
  if (action_) stop_ = make_event(StopCommand{}, CommandRetry::kNever, time);
  action_.reset();
  head_.reset();
  head_angles_.clear();
  walk({}, time);
}

void MotionDriver::abandon() {
  walk_id_ = 0;
  num_zeros_left_ = 0;
  action_.reset();
  stop_.reset();
  head_.reset();
  head_angles_.clear();
  ended_.reset();
}

void MotionDriver::handle_result(const CommandResult& result, double time) {
  if (result.source != source_) return;
  const bool is_final = result.status != ResultStatus::kAccepted;
  if (action_ && action_->command.id == result.id) {
    action_->retry.handle_result(result.status, time);
    if (!action_->retry.has_ended()) return;
    ended_ = result;
    action_.reset();
    return;
  }
  if (head_ && head_->command.id == result.id) head_->retry.handle_result(result.status, time);
  if (stop_ && stop_->command.id == result.id) stop_->retry.handle_result(result.status, time);
  // The next velocity begins a new walk.
  if (is_final && walk_id_ == result.id) walk_id_ = 0;
}

std::vector<Command> MotionDriver::step(double time) {
  std::vector<Command> commands;
  if (action_) {
    if (action_->retry.should_send(time)) commands.push_back(action_->command);
    if (action_->retry.has_timed_out(time)) {
      ended_ =
          CommandResult{source_, action_->command.id, CommandKind::kAction, ResultStatus::kFailed};
      action_.reset();
    }
  }
  if (stop_) {
    if (stop_->retry.should_send(time)) commands.push_back(stop_->command);
    if (stop_->retry.is_accepted() || stop_->retry.has_ended() ||
        stop_->retry.has_timed_out(time)) {
      stop_.reset();
    }
  }
  if (head_) {
    if (head_->retry.should_send(time)) commands.push_back(head_->command);
    if (head_->retry.is_accepted() || head_->retry.has_ended() ||
        head_->retry.has_timed_out(time)) {
      head_.reset();
    }
  }
  const bool is_due = time - last_walk_sent_ >= kWalkPeriod || time < last_walk_sent_;
  if ((walk_id_ != 0 || num_zeros_left_ > 0) && is_due) {
    last_walk_sent_ = time;
    if (walk_id_ == 0) --num_zeros_left_;
    commands.push_back({source_, last_walk_id_, walk_id_ == 0 ? WalkCommand{} : velocity_});
  }
  return commands;
}

std::optional<CommandResult> MotionDriver::take_ended() {
  return std::exchange(ended_, std::nullopt);
}

}  // namespace nao::play
