#include "viewer/command_sender.h"

#include <unistd.h>

#include <algorithm>
#include <naolcm/action_command_t.hpp>
#include <naolcm/command_result_t.hpp>
#include <naolcm/posture_command_t.hpp>
#include <naolcm/stop_command_t.hpp>
#include <naolcm/walk_command_t.hpp>
#include <naolcm/world_command_t.hpp>
#include <naolcm/world_truth_t.hpp>

#include "common/bus.h"
#include "common/wall_clock.h"

namespace nao::viewer {
namespace {

/** Period and end of the repetitions, s. Chosen: a period of many times the latency of a bus on one
 * network, and ten repetitions, of which a running receiver answers at least one. */
constexpr CommandRetry::Timing kTiming{.repeat_period = 0.2, .answer_timeout = 2.0};

}  // namespace

CommandSender::CommandSender(Bus& bus, const RobotChannels& channels)
    : bus_(bus),
      channels_(channels),
      source_("viewer." + std::to_string(getpid())),
      // Ids above those of an earlier viewer with the same process id, which must not be reused.
      last_id_(wall_utime()) {}

template <class Message>
Message CommandSender::make_command() {
  Message message{};
  message.wall_utime = wall_utime();
  message.source = source_;
  message.command_id = ++last_id_;
  return message;
}

// The command is sent now, and repeated by repeat() until it is answered.
void CommandSender::send(const std::string& name, int64_t id, std::function<void()> publish) {
  const double now = monotonic_seconds();
  Pending& pending =
      pending_.emplace_back(Pending{id, name, std::move(publish), CommandRetry(kTiming, now)});
  if (pending.retry.should_send(now)) pending.publish();
}

void CommandSender::go_to_posture(const std::string& posture, double speed) {
  auto command = make_command<naolcm::posture_command_t>();
  command.posture = posture;
  command.speed = speed;
  send("posture " + posture, command.command_id,
       [this, command] { bus_.publish(channels_.posture_command, command); });
}

void CommandSender::start_action(const std::string& action) {
  auto command = make_command<naolcm::action_command_t>();
  command.action = action;
  send("action " + action, command.command_id,
       [this, command] { bus_.publish(channels_.action_command, command); });
}

void CommandSender::stop() {
  const auto command = make_command<naolcm::stop_command_t>();
  send("stop", command.command_id,
       [this, command] { bus_.publish(channels_.stop_command, command); });
}

void CommandSender::walk(double vx, double vy, double wz) {
  auto command = make_command<naolcm::walk_command_t>();
  // All messages of one walk have the same id.
  if (walk_id_ == 0) walk_id_ = command.command_id;
  command.command_id = walk_id_;
  command.vx = vx;
  command.vy = vy;
  command.wz = wz;
  bus_.publish(channels_.walk_command, command);
}

void CommandSender::end_walk() {
  if (walk_id_ == 0) return;
  walk(0, 0, 0);
  walk_id_ = 0;
}

void CommandSender::send_world_command(const std::string& command, int64_t num_ticks) {
  auto message = make_command<naolcm::world_command_t>();
  message.command = command;
  message.num_ticks = num_ticks;
  send_world(message);
}

void CommandSender::place_ball(double x, double y) {
  auto message = make_command<naolcm::world_command_t>();
  message.command = "place-ball";
  message.position_in_world[0] = x;
  message.position_in_world[1] = y;
  // Only the last place of a dragged ball counts: earlier ones are not repeated.
  std::erase_if(pending_, [&](const Pending& pending) { return pending.name == message.command; });
  send_world(message);
}

void CommandSender::push(const std::string& robot, const std::string& link,
                         const Eigen::Vector3d& impulse) {
  auto message = make_command<naolcm::world_command_t>();
  message.command = "push";
  message.robot = robot;
  message.link = link;
  Eigen::Map<Eigen::Vector3d>(message.impulse_in_world) = impulse;
  send_world(message);
}

void CommandSender::send_world(const naolcm::world_command_t& command) {
  send(command.command, command.command_id,
       [this, command] { bus_.publish(kWorldCommandChannel, command); });
}

void CommandSender::receive(const naolcm::command_result_t& result) {
  if (result.source != source_) return;
  std::erase_if(pending_, [&](const Pending& pending) { return pending.id == result.command_id; });
}

// Simulators acknowledge world commands in the truth, not by results.
void CommandSender::receive(const naolcm::world_truth_t& truth) {
  if (truth.last_command_source != source_) return;
  const auto acknowledged =
      std::find_if(pending_.begin(), pending_.end(),
                   [&](const Pending& pending) { return pending.id == truth.last_command_id; });
  if (acknowledged == pending_.end()) return;
  last_outcome_ = acknowledged->name + ": " +
                  (truth.last_command_error.empty() ? "done" : truth.last_command_error);
  pending_.erase(acknowledged);
}

void CommandSender::repeat(double now) {
  for (Pending& pending : pending_) {
    if (pending.retry.should_send(now)) pending.publish();
  }
  std::erase_if(pending_, [&](const Pending& pending) {
    if (!pending.retry.has_timed_out(now)) return false;
    last_outcome_ = pending.name + ": no answer within 2 s";
    return true;
  });
}

}  // namespace nao::viewer
