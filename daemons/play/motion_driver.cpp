#include "daemons/play/motion_driver.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace nao::play {
namespace {

/** Time between two transmissions of an action that was accepted, s: its result may have been lost.
 */
constexpr double kConfirmPeriod = 1;
/** Least change of the head's angles that is commanded, rad, and least time between two, s. */
constexpr double kHeadStep = 0.03;
constexpr double kHeadPeriod = 0.12;
/** Fraction of the joints' maximum speed. Chosen: 1 rad in 0.4 s, without shaking the walk. */
constexpr double kHeadSpeed = 0.3;

}  // namespace

int64_t MotionDriver::send(decltype(Command::request) request, double time,
                           const CommandTiming& timing) {
  const int64_t id = next_id_++;
  sender_.send({source_, id, std::move(request)}, time, {}, timing);
  return id;
}

void MotionDriver::walk(const WalkCommand& velocity, double time) {
  const Command command{source_, walk_id_, velocity};
  if (is_zero(velocity)) {
    if (std::exchange(walk_id_, 0) != 0) sender_.end(command);
  } else if (walk_id_ == 0) {
    sender_.cease(last_walk_id_);
    walk_id_ = last_walk_id_ = send(velocity, time, CommandTiming::of_stream());
  } else {
    sender_.update(command, false);
  }
}

void MotionDriver::perform(const ActionCommand& action, bool walks_on, double time) {
  if (!walks_on) {
    // No zeros are sent: the action replaces the walk.
    sender_.cease(last_walk_id_);
    walk_id_ = 0;
  }
  sender_.cease(head_id_);
  sender_.cease(action_id_);
  head_angles_.clear();
  ended_.reset();
  action_id_ = send(action, time, {.confirm_period = kConfirmPeriod});
}

void MotionDriver::turn_head(const std::vector<double>& angles, double time) {
  // During an action, the action controls the head.
  if (is_performing() || time - last_head_ < kHeadPeriod) return;
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
  if (command.joint_names.empty()) return;
  sender_.cease(head_id_);
  head_id_ = send(command, time, {});
}

void MotionDriver::stop(double time) {
  sender_.cease(head_id_);
  head_angles_.clear();
  if (action_id_ != 0) {
    sender_.cease(action_id_);
    action_id_ = 0;
    send(StopCommand{}, time, {});
  }
  walk({}, time);
}

void MotionDriver::abandon() {
  sender_ = {};
  walk_id_ = 0;
  action_id_ = 0;
  head_angles_.clear();
  ended_.reset();
}

void MotionDriver::handle_result(const CommandResult& result, double time) {
  const auto entry = sender_.handle_result(result.source, result.id, result.status, time);
  if (!entry || result.status == ResultStatus::kAccepted) return;
  if (result.id == action_id_) {
    ended_ = result;
    action_id_ = 0;
  }
  // The next velocity begins a new walk.
  if (result.id == walk_id_) walk_id_ = 0;
}

std::vector<Command> MotionDriver::step(double time) {
  for (const auto& entry : sender_.take_timed_out(time)) {
    if (entry.command.id != action_id_) continue;
    ended_ = CommandResult{source_, action_id_, CommandKind::kAction, ResultStatus::kFailed};
    action_id_ = 0;
  }
  return sender_.take_due(time);
}

std::optional<CommandResult> MotionDriver::take_ended() {
  return std::exchange(ended_, std::nullopt);
}

}  // namespace nao::play
