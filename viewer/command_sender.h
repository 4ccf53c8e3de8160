#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "common/channels.h"
#include "messages/command_retry.h"

namespace naolcm {
class command_result_t;
class world_command_t;
class world_truth_t;
}  // namespace naolcm

namespace nao {
class Bus;
}

namespace nao::viewer {

/** Sends the viewer's commands; repeats each until it is acknowledged or 2 s have passed. */
class CommandSender {
 public:
  /** @param bus  Must outlive this. */
  CommandSender(Bus& bus, const RobotChannels& channels);

  /** @param speed  Fraction of the maximum speed, (0, 1]. */
  void go_to_posture(const std::string& posture, double speed);
  void start_action(const std::string& action);
  void stop();
  /** Sends one message of a walk; to be repeated while the robot should walk.
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
  /** A command that is not acknowledged. */
  struct Pending {
    int64_t id;
    std::string name;
    std::function<void()> publish;
    CommandRetry retry;
  };

  void send(const std::string& name, int64_t id, std::function<void()> publish);
  void send_world(const naolcm::world_command_t& command);
  /** A message with source, command id and time. */
  template <class Message>
  Message make_command();

  Bus& bus_;
  RobotChannels channels_;
  std::string source_;
  int64_t last_id_;
  /** Command id of the current walk; 0: none. */
  int64_t walk_id_ = 0;
  std::vector<Pending> pending_;
  std::string last_outcome_;
};

}  // namespace nao::viewer
