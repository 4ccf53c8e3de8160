#pragma once

#include <array>
#include <vector>

#include "messages/reason.h"
#include "phone-gateway/server/core/gateway_limits.h"

namespace nao::gateway {

/** Components that the gateway depends on. The values are those of Notice.Component. */
enum class Component { kMotion, kRobot, kCamera };

inline constexpr std::array kComponents = {Component::kMotion, Component::kRobot,
                                           Component::kCamera};

/** "motion", "robot" or "camera". */
const char* to_string(Component component);

/** The reason that clients get: "motion-unavailable", "camera-available", ... */
Reason availability_reason(Component component, bool is_available);

/** Detects from the times of their last messages when nao-motion, the robot or its camera becomes
 * unavailable or available. */
class ComponentMonitor {
 public:
  struct Change {
    Component component;
    bool is_available;
  };

  explicit ComponentMonitor(const GatewayLimits& limits) : limits_(limits) {}

  /** A motion_state_t was received. @param has_robot  Its mode is not MODE_NO_ROBOT. */
  void handle_motion_state(bool has_robot, double now);
  /** A robot_state_t was received. */
  void handle_robot_state(double now) { last_robot_state_ = now; }
  /** An image was received. */
  void handle_image(double now) { last_image_ = now; }
  /** The camera's DAEMON_STATUS was received. */
  void handle_camera_status(double now) { last_camera_status_ = now; }
  /** The simulator's DAEMON_STATUS was received: the robot is a simulated one. */
  void handle_simulator_status(double now) { last_simulator_status_ = now; }
  bool is_simulated(double now) const {
    return now - last_simulator_status_ <= limits_.simulator_timeout;
  }
  /** Whether a client requests images, so that the camera must send them. */
  void set_images_requested(bool are_requested, double now);

  /** Updates the availabilities. @return What has changed. */
  std::vector<Change> step(double now);

  bool is_available(Component component) const {
    return available_[static_cast<size_t>(component)];
  }

 private:
  bool calc_available(Component component, double now) const;

  static constexpr double kNever = -1e9;
  GatewayLimits limits_;
  std::array<bool, kComponents.size()> available_{};
  bool motion_has_robot_ = false;
  bool are_images_requested_ = false;
  double images_requested_since_ = kNever;
  double robot_available_since_ = kNever;
  double last_motion_state_ = kNever;
  double last_robot_state_ = kNever;
  double last_image_ = kNever;
  double last_camera_status_ = kNever;
  double last_simulator_status_ = kNever;
};

}  // namespace nao::gateway
