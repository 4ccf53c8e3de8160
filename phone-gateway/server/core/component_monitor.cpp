#include "phone-gateway/server/core/component_monitor.h"

#include <algorithm>

#include "messages/enum_names.h"
#include "phone-gateway/server/core/gateway_reasons.h"

namespace nao::gateway {

static_assert(static_cast<int>(Component::kMotion) == naoremote::Notice::MOTION);
static_assert(static_cast<int>(Component::kRobot) == naoremote::Notice::ROBOT);
static_assert(static_cast<int>(Component::kCamera) == naoremote::Notice::CAMERA);

const char* to_string(Component component) {
  static constexpr auto kNames = std::to_array<const char*>({"motion", "robot", "camera"});
  return name_in(kNames, component);
}

Reason availability_reason(Component component, bool is_available) {
  switch (component) {
    case Component::kMotion:
      return is_available ? gateway_reason("motion-available")
                          : gateway_reason("motion-unavailable");
    case Component::kRobot:
      return is_available ? gateway_reason("robot-available") : gateway_reason("robot-unavailable");
    case Component::kCamera:
      return is_available ? gateway_reason("camera-available")
                          : gateway_reason("camera-unavailable");
  }
  return {};
}

void ComponentMonitor::handle_motion_state(bool has_robot, double now) {
  last_motion_state_ = now;
  motion_has_robot_ = has_robot;
}

void ComponentMonitor::set_images_requested(bool are_requested, double now) {
  // The camera's time starts with the first request, not with the last image of long ago.
  if (are_requested && !are_images_requested_) images_requested_since_ = now;
  are_images_requested_ = are_requested;
}

// Changes since the last call, each once.
std::vector<ComponentMonitor::Change> ComponentMonitor::step(double now) {
  std::vector<Change> changes;
  for (const Component component : kComponents) {
    const bool is_available_now = calc_available(component, now);
    bool& is_available = available_[static_cast<size_t>(component)];
    if (is_available == is_available_now) continue;
    is_available = is_available_now;
    if (component == Component::kRobot && is_available) robot_available_since_ = now;
    changes.push_back({component, is_available});
  }
  return changes;
}

bool ComponentMonitor::calc_available(Component component, double now) const {
  const bool has_motion = now - last_motion_state_ <= limits_.motion_timeout;
  const bool has_robot =
      has_motion && motion_has_robot_ && now - last_robot_state_ <= limits_.robot_timeout;
  switch (component) {
    case Component::kMotion:
      return has_motion;
    case Component::kRobot:
      return has_robot;
    case Component::kCamera: {
      // The camera must send images only while a client requests them and the robot's time
      // advances. The timeout counts from the latest of request, robot and last image.
      const double expected_since =
          std::max({images_requested_since_, robot_available_since_, last_image_});
      const bool is_image_overdue =
          are_images_requested_ && has_robot && now - expected_since > limits_.image_timeout;
      const double last_message = std::max(last_camera_status_, last_image_);
      return !is_image_overdue && now - last_message <= limits_.camera_status_timeout;
    }
  }
  return false;
}

}  // namespace nao::gateway
