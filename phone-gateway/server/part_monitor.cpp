#include "phone-gateway/server/part_monitor.h"

#include <algorithm>

namespace nao {

void PartMonitor::heard_motion(bool has_robot, double now) {
  last_motion_ = now;
  motion_has_robot_ = has_robot;
}

void PartMonitor::set_watched(bool is_watched, double now) {
  if (is_watched && !is_watched_) watched_since_ = now;
  is_watched_ = is_watched;
}

std::vector<PartMonitor::Change> PartMonitor::step(double now) {
  std::vector<Change> changes;
  for (const Part part : {Part::kMotion, Part::kRobot, Part::kCamera}) {
    const bool is_available_now = calc_available(part, now);
    bool& is_available = available_[static_cast<int>(part)];
    if (is_available == is_available_now) continue;
    is_available = is_available_now;
    if (part == Part::kRobot && is_available) robot_since_ = now;
    changes.push_back({part, is_available});
  }
  return changes;
}

bool PartMonitor::calc_available(Part part, double now) const {
  const bool has_motion = now - last_motion_ <= limits_.motion_silence_time;
  const bool has_robot =
      has_motion && motion_has_robot_ && now - last_robot_ <= limits_.robot_silence_time;
  switch (part) {
    case Part::kMotion:
      return has_motion;
    case Part::kRobot:
      return has_robot;
    case Part::kCamera: {
      // Images are due only from a robot that moves in time, and to somebody who watches.
      const double images_due_since = std::max({watched_since_, robot_since_, last_image_});
      const bool owes_image =
          is_watched_ && has_robot && now - images_due_since > limits_.image_silence_time;
      const double last_sign = std::max(last_camera_status_, last_image_);
      return !owes_image && now - last_sign <= limits_.camera_status_silence_time;
    }
  }
  return false;
}

const char* part_name(PartMonitor::Part part) {
  switch (part) {
    case PartMonitor::Part::kMotion:
      return "motion";
    case PartMonitor::Part::kRobot:
      return "robot";
    case PartMonitor::Part::kCamera:
      return "camera";
  }
  return "";
}

std::string describe(const PartMonitor::Change& change) {
  switch (change.part) {
    case PartMonitor::Part::kMotion:
      return change.is_available ? "The robot's motion program is back."
                                 : "The robot's motion program does not answer.";
    case PartMonitor::Part::kRobot:
      return change.is_available ? "The robot is back." : "The robot does not answer.";
    case PartMonitor::Part::kCamera:
      return change.is_available ? "The head camera is back." : "The head camera sends no images.";
  }
  return "";
}

}  // namespace nao
