#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "kinematics/pose2.h"
#include "messages/command.h"
#include "messages/mode.h"
#include "remote.pb.h"

namespace nao::gateway {

/** The part of robot_state_t that clients receive. */
struct RobotSnapshot {
  /** Robot time, microseconds. */
  int64_t utime = 0;
  /** rad (hands: opening), in the order of RobotDescription.joints. */
  std::vector<double> joint_position;
  /** Unit quaternion (w, x, y, z) and position, m, of the torso in the odometry frame. */
  std::array<double, 4> torso_orientation{1, 0, 0, 0};
  std::array<double, 3> torso_position{};

  /** Ground projection of the torso's pose. */
  Pose2 torso_on_ground() const;
};

/** The part of motion_state_t that clients receive; see there. */
struct MotionSnapshot {
  Mode mode = Mode::kNoRobot;
  std::string posture;
  /** Motion being executed, if any. */
  std::optional<naoremote::Activity> activity;
  /** 0 to 1; negative where the end is open. */
  double progress = -1;
  /** Velocity being executed, m/s, m/s, rad/s. */
  WalkCommand velocity;
  double stiffness = 0;
};

/** The newest robot and motion state, and the State message made of them. */
class RobotMirror {
 public:
  void set(const RobotSnapshot& robot, double now) {
    robot_ = robot;
    received_at_ = now;
    has_state_ = true;
  }
  void set(const MotionSnapshot& motion) { motion_ = motion; }
  /** @param light_rgb  0xRRGGBB, in the order of RobotDescription.lights. */
  void set_lights(std::vector<uint32_t> light_rgb) { light_rgb_ = std::move(light_rgb); }
  /** None: nothing is known of the robot's body. */
  void set_body(std::optional<naoremote::Body> body) { body_ = std::move(body); }

  /** False until the first state of the robot has been received. */
  bool has_state() const { return has_state_; }

  const RobotSnapshot& robot() const { return robot_; }
  const MotionSnapshot& motion() const { return motion_; }
  const std::optional<naoremote::Body>& body() const { return body_; }

  /** Robot time at `now`, microseconds: that of the newest state plus the time since; 0 if unknown.
   */
  int64_t calc_robot_utime(double now) const;

  /** Fills in a State. @param is_available  False: the robot does not answer; the State has its
   * last pose and MODE_NO_ROBOT. */
  void write(naoremote::State& state, bool is_available, double now) const;

 private:
  RobotSnapshot robot_;
  MotionSnapshot motion_;
  std::vector<uint32_t> light_rgb_;
  std::optional<naoremote::Body> body_;
  double received_at_ = 0;
  bool has_state_ = false;
};

}  // namespace nao::gateway
