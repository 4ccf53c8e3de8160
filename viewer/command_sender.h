#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <naolcm/command_result_t.hpp>
#include <naolcm/world_command_t.hpp>
#include <naolcm/world_truth_t.hpp>
#include <string>
#include <vector>

#include "common/bus.h"
#include "common/channels.h"

namespace nao {

/** Sends the viewer's commands and repeats each until it is answered or 2 s have passed. */
class CommandSender {
 public:
  /** @param bus  Must outlive this. */
  CommandSender(Bus& bus, const RobotChannels& channels);

  void go_to_posture(const std::string& posture, double speed);
  void act(const std::string& action);
  void stop();
  /** One message of a walk; repeat it while the walk is wished. Velocities: m/s, m/s, rad/s. */
  void walk(double vx, double vy, double wz);
  /** The next walk is a new one. */
  void end_walk();

  /** pause, resume, step or reset. @param num_ticks  For step. */
  void change_world(const std::string& command, int64_t num_ticks = 0);
  /** @param x, y  m, in the world. */
  void place_ball(double x, double y);
  /** @param impulse  N s, in the world, at the link's centre of mass. */
  void push(const std::string& robot, const std::string& link, const Eigen::Vector3d& impulse);

  void receive(const naolcm::command_result_t& result);
  void receive(const naolcm::world_truth_t& truth);

  /** Sends again what is not answered; call it in every turn. @param now  s. */
  void repeat(double now);

  /** What became of the last command that is not a motion command, in words; empty at first. */
  const std::string& last_outcome() const { return last_outcome_; }

 private:
  struct Pending {
    int64_t id;
    std::string what;
    std::function<void()> send;
    double next;
    double until;
  };

  void start(const std::string& what, int64_t id, std::function<void()> send);
  void send_world(const naolcm::world_command_t& command);
  template <class Message>
  Message stamped();

  Bus& bus_;
  RobotChannels channels_;
  std::string source_;
  int64_t last_id_;
  int64_t walk_id_ = 0;
  std::vector<Pending> pending_;
  std::string last_outcome_;
};

}  // namespace nao
