#include "viewer/command_sender.h"

#include <unistd.h>

#include <Eigen/Core>
#include <algorithm>
#include <naolcm/action_command_t.hpp>
#include <naolcm/posture_command_t.hpp>
#include <naolcm/stop_command_t.hpp>
#include <naolcm/walk_command_t.hpp>

#include "common/wall_clock.h"

namespace nao {
namespace {

constexpr double kRepeat = 0.2;
constexpr double kGiveUp = 2.0;

}  // namespace

CommandSender::CommandSender(Bus& bus, const RobotChannels& channels)
    : bus_(bus),
      channels_(channels),
      source_("viewer." + std::to_string(getpid())),
      // Not the numbers of an earlier viewer that had the same process id.
      last_id_(wall_utime()) {}

template <class Message>
Message CommandSender::stamped() {
  Message message{};
  message.wall_utime = wall_utime();
  message.source = source_;
  message.command_id = ++last_id_;
  return message;
}

void CommandSender::start(const std::string& what, int64_t id, std::function<void()> send) {
  const double now = monotonic_seconds();
  send();
  pending_.push_back({id, what, std::move(send), now + kRepeat, now + kGiveUp});
}

void CommandSender::go_to_posture(const std::string& posture, double speed) {
  auto command = stamped<naolcm::posture_command_t>();
  command.posture = posture;
  command.speed = speed;
  start("posture " + posture, command.command_id,
        [this, command] { bus_.publish(channels_.posture_command, command); });
}

void CommandSender::act(const std::string& action) {
  auto command = stamped<naolcm::action_command_t>();
  command.action = action;
  start("action " + action, command.command_id,
        [this, command] { bus_.publish(channels_.action_command, command); });
}

void CommandSender::stop() {
  const auto command = stamped<naolcm::stop_command_t>();
  start("stop", command.command_id,
        [this, command] { bus_.publish(channels_.stop_command, command); });
}

void CommandSender::walk(double vx, double vy, double wz) {
  auto command = stamped<naolcm::walk_command_t>();
  if (walk_id_ == 0) walk_id_ = command.command_id;
  command.command_id = walk_id_;
  command.vx = vx;
  command.vy = vy;
  command.wz = wz;
  bus_.publish(channels_.walk_command, command);
}

void CommandSender::end_walk() {
  walk_id_ = 0;
}

void CommandSender::change_world(const std::string& command, int64_t num_ticks) {
  auto message = stamped<naolcm::world_command_t>();
  message.command = command;
  message.num_ticks = num_ticks;
  send_world(message);
}

void CommandSender::place_ball(double x, double y) {
  auto message = stamped<naolcm::world_command_t>();
  message.command = "place-ball";
  message.position_in_world[0] = x;
  message.position_in_world[1] = y;
  // Only where the ball is wanted last.
  std::erase_if(pending_, [](const Pending& pending) { return pending.what == "place-ball"; });
  send_world(message);
}

void CommandSender::push(const std::string& robot, const std::string& link,
                         const Eigen::Vector3d& impulse) {
  auto message = stamped<naolcm::world_command_t>();
  message.command = "push";
  message.robot = robot;
  message.link = link;
  Eigen::Map<Eigen::Vector3d>(message.impulse_in_world) = impulse;
  send_world(message);
}

void CommandSender::send_world(const naolcm::world_command_t& command) {
  start(command.command, command.command_id,
        [this, command] { bus_.publish(kWorldCommandChannel, command); });
}

void CommandSender::receive(const naolcm::command_result_t& result) {
  if (result.source != source_) return;
  std::erase_if(pending_, [&](const Pending& pending) { return pending.id == result.command_id; });
}

void CommandSender::receive(const naolcm::world_truth_t& truth) {
  if (truth.last_command_source != source_) return;
  const auto place = std::find_if(pending_.begin(), pending_.end(), [&](const Pending& pending) {
    return pending.id == truth.last_command_id;
  });
  if (place == pending_.end()) return;
  last_outcome_ =
      place->what + ": " + (truth.last_command_error.empty() ? "done" : truth.last_command_error);
  pending_.erase(place);
}

void CommandSender::repeat(double now) {
  for (Pending& pending : pending_) {
    if (now < pending.next) continue;
    pending.send();
    pending.next = now + kRepeat;
  }
  std::erase_if(pending_, [&](const Pending& pending) {
    if (now < pending.until) return false;
    last_outcome_ = pending.what + ": nobody answered";
    return true;
  });
}

}  // namespace nao
