#include "viewer/viewer_commands.h"

#include <unistd.h>

#include <naolcm/camera_command_t.hpp>
#include <naolcm/command_result_t.hpp>
#include <naolcm/world_command_t.hpp>
#include <naolcm/world_truth_t.hpp>

#include "common/bus.h"
#include "common/wall_clock.h"

namespace nao::viewer {
ViewerCommands::ViewerCommands(Bus& bus, const RobotChannels& channels)
    : channels_(channels),
      commands_(bus, channels_),
      source_("viewer." + std::to_string(getpid())),
      // Ids above those of an earlier viewer with the same process id, which must not be reused.
      last_id_(wall_utime()) {}

ViewerCommands::Outgoing ViewerCommands::outgoing(int64_t id, decltype(Command::request) request) {
  const Command command{source_, id, std::move(request)};
  return {source_, id, describe(command), [this, command] { commands_.publish(command); }};
}

void ViewerCommands::send(Outgoing command) {
  const double now = monotonic_seconds();
  sender_.send(std::move(command), now);
  repeat(now);
}

void ViewerCommands::go_to_posture(const std::string& posture, double speed) {
  send(outgoing(++last_id_, PostureCommand{posture, speed}));
}

void ViewerCommands::start_action(const std::string& action) {
  send(outgoing(++last_id_, ActionCommand{.action = action}));
}

void ViewerCommands::stop() {
  send(outgoing(++last_id_, StopCommand{}));
}

void ViewerCommands::walk(double vx, double vy, double wz) {
  const WalkCommand velocity{vx, vy, wz};
  if (sender_.update(outgoing(walk_id_, velocity), false)) return;
  sender_.cease(ended_walk_id_);
  walk_id_ = ++last_id_;
  const double now = monotonic_seconds();
  sender_.send(outgoing(walk_id_, velocity), now, {}, CommandTiming::of_stream());
  repeat(now);
}

void ViewerCommands::end_walk() {
  if (walk_id_ == 0) return;
  sender_.end(outgoing(walk_id_, WalkCommand{}));
  ended_walk_id_ = std::exchange(walk_id_, 0);
  repeat(monotonic_seconds());
}

void ViewerCommands::request_images(const naolcm::camera_command_t& request) {
  commands_.publish(channels_.head_camera_command, request, source_);
}

void ViewerCommands::send_world_command(const std::string& command, int64_t num_ticks) {
  naolcm::world_command_t message{};
  message.command = command;
  message.num_ticks = num_ticks;
  send_world(message);
}

void ViewerCommands::place_ball(double x, double y) {
  naolcm::world_command_t message{};
  message.command = "place-ball";
  message.position_in_world[0] = x;
  message.position_in_world[1] = y;
  // Only the last place of a dragged ball counts: earlier ones are not repeated.
  sender_.take_if([&](const auto& entry) { return entry.command.name == message.command; });
  send_world(message);
}

void ViewerCommands::push(const std::string& robot, const std::string& link,
                          const Eigen::Vector3d& impulse) {
  naolcm::world_command_t message{};
  message.command = "push";
  message.robot = robot;
  message.link = link;
  Eigen::Map<Eigen::Vector3d>(message.impulse_in_world) = impulse;
  send_world(message);
}

void ViewerCommands::send_world(const naolcm::world_command_t& command) {
  const int64_t id = ++last_id_;
  send({source_, id, command.command,
        [this, command, id] { commands_.publish(kWorldCommandChannel, command, source_, id); }});
}

void ViewerCommands::receive(const naolcm::command_result_t& result) {
  sender_.handle_result(result.source, result.command_id, static_cast<ResultStatus>(result.status),
                        monotonic_seconds());
}

// Simulators acknowledge world commands in the truth, not by results.
void ViewerCommands::receive(const naolcm::world_truth_t& truth) {
  const auto acknowledged = sender_.handle_result(truth.last_command_source, truth.last_command_id,
                                                  ResultStatus::kDone, monotonic_seconds());
  if (!acknowledged) return;
  last_outcome_ = acknowledged->command.name + ": " +
                  (truth.last_command_error.empty() ? "done" : truth.last_command_error);
}

void ViewerCommands::repeat(double now) {
  for (const Outgoing& command : sender_.take_due(now)) command.publish();
  for (const auto& entry : sender_.take_timed_out(now)) {
    last_outcome_ = entry.command.name + ": no answer";
  }
}

}  // namespace nao::viewer
