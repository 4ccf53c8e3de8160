#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <string>

#include "common/channels.h"
#include "messages/command_publisher.h"
#include "messages/command_sender.h"

namespace naolcm {
class camera_command_t;
class command_result_t;
class world_command_t;
class world_truth_t;
}  // namespace naolcm

namespace nao {
class Bus;
}

namespace nao::viewer {

/** Sends the viewer's commands; repeats each until it is acknowledged, a walk as long as it lasts.
 */
class ViewerCommands {
 public:
  /** @param bus  Must outlive this. */
  ViewerCommands(Bus& bus, const RobotChannels& channels);

  /** @param speed  Fraction of the maximum speed, (0, 1]. */
  void go_to_posture(const std::string& posture, double speed);
  void start_action(const std::string& action);
  void stop();
  /** Begins a walk, or changes its velocity.
   * @param vx, vy, wz  Commanded velocity: m/s forward, m/s to the left, rad/s. */
  void walk(double vx, double vy, double wz);
  /** Ends the walk, if there is one, with the velocity zero: the next walk() is a new command. */
  void end_walk();

  /** Sends a command of the simulator without arguments: "pause", "resume", "step" or "reset".
   * @param num_ticks  Number of ticks of "step". */
  void send_world_command(const std::string& command, int64_t num_ticks = 0);
  /** Places the ball; replaces an earlier placement that is not acknowledged yet.
   * @param x, y  m, in the world. */
  void place_ball(double x, double y);
  /** @param impulse  N s, in the world, at the link's center of mass. */
  void push(const std::string& robot, const std::string& link, const Eigen::Vector3d& impulse);

  /** Sends an image request, which is to be repeated once a second. */
  void request_images(const naolcm::camera_command_t& request);

  /** Takes the acknowledgement of a command. */
  void receive(const naolcm::command_result_t& result);
  void receive(const naolcm::world_truth_t& truth);

  /** Repeats the commands that are not acknowledged; to be called in every frame.
   * @param now  s, monotonic. */
  void repeat(double now);

  /** Outcome of the last command to the simulator, or of the last command that was not
   * acknowledged, in words; empty if there is none. */
  const std::string& last_outcome() const { return last_outcome_; }

 private:
  struct Outgoing {
    std::string source;
    int64_t id;
    std::string name;
    std::function<void()> publish;
  };

  Outgoing outgoing(int64_t id, decltype(Command::request) request);
  void send(Outgoing command);
  void send_world(const naolcm::world_command_t& command);

  RobotChannels channels_;
  CommandPublisher commands_;
  std::string source_;
  int64_t last_id_;
  /** Command ids of the current walk, 0: none, and of the last one that was ended. */
  int64_t walk_id_ = 0;
  int64_t ended_walk_id_ = 0;
  CommandSender<Outgoing> sender_;
  std::string last_outcome_;
};

}  // namespace nao::viewer
