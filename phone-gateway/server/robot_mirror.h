#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "messages/mode.h"
#include "phone-gateway/server/motion_command.h"
#include "remote.pb.h"

namespace nao {

/** What the gateway takes from robot_state_t. */
struct RobotSnapshot {
  /** Robot time, microseconds. */
  int64_t utime = 0;
  /** rad (hands: opening), in the order of RobotDescription.joints. */
  std::vector<double> joint_position;
  /** Unit quaternion (w, x, y, z) and position, m, of the torso in the odometry frame. */
  std::array<double, 4> torso_orientation{1, 0, 0, 0};
  std::array<double, 3> torso_position{};
};

/** What the gateway takes from motion_state_t; see there. */
struct MotionSnapshot {
  Mode mode = Mode::kNoRobot;
  std::string posture;
  /** Motion being executed; nothing if none. */
  std::optional<naoremote::Activity> activity;
  /** 0 to 1; negative where the end is open. */
  double progress = -1;
  /** m/s, m/s, rad/s. */
  WalkVelocity velocity;
  double stiffness = 0;
};

/** The newest that is known about the robot, made into the State that phones get. */
class RobotMirror {
 public:
  void set(const RobotSnapshot& robot, double now) {
    robot_ = robot;
    robot_time_ = now;
    has_robot_ = true;
  }
  void set(const MotionSnapshot& motion) { motion_ = motion; }

  /** False until the first state of the robot has come. */
  bool has_state() const { return has_robot_; }

  /** Robot time at `now`, microseconds, from the newest state and the time since; 0 if unknown. */
  int64_t calc_robot_utime(double now) const;

  /** Fills in a State. @param is_available  False: it is the last known state of a robot that does
   * not answer, and its mode says so. */
  void write(naoremote::State& state, bool is_available, double now) const;

 private:
  RobotSnapshot robot_;
  MotionSnapshot motion_;
  double robot_time_ = 0;
  bool has_robot_ = false;
};

}  // namespace nao
