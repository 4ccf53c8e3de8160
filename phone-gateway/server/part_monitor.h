#pragma once

#include <string>
#include <vector>

#include "phone-gateway/server/gateway_limits.h"

namespace nao {

/** Notices when nao-motion, the robot or its camera goes away or comes back, from when they were
 * last heard. */
class PartMonitor {
 public:
  enum class Part { kMotion, kRobot, kCamera };
  struct Change {
    Part part;
    bool is_available;
  };

  explicit PartMonitor(const GatewayLimits& limits) : limits_(limits) {}

  /** nao-motion spoke. @param has_robot  Whether it says that there is a robot. */
  void heard_motion(bool has_robot, double now);
  /** A state of the robot came. */
  void heard_robot(double now) { last_robot_ = now; }
  /** A image came. */
  void heard_image(double now) { last_image_ = now; }
  /** The camera's DAEMON_STATUS came. */
  void heard_camera_status(double now) { last_camera_status_ = now; }
  /** Whether somebody watches, so that images ought to come. */
  void set_watched(bool is_watched, double now);

  /** Brings the availabilities up to date. @return What has changed. */
  std::vector<Change> step(double now);

  bool is_available(Part part) const { return available_[static_cast<int>(part)]; }

 private:
  bool calc_available(Part part, double now) const;

  static constexpr double kNever = -1e9;
  GatewayLimits limits_;
  bool available_[3] = {false, false, false};
  bool motion_has_robot_ = false;
  bool is_watched_ = false;
  double watched_since_ = kNever;
  double robot_since_ = kNever;
  double last_motion_ = kNever;
  double last_robot_ = kNever;
  double last_image_ = kNever;
  double last_camera_status_ = kNever;
};

/** Name of a part as in Notice.part: "motion", "robot" or "camera". */
const char* part_name(PartMonitor::Part part);

/** What a change means, as a sentence for a person. */
std::string describe(const PartMonitor::Change& change);

}  // namespace nao
