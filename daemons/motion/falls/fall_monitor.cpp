#include "daemons/motion/falls/fall_monitor.h"

#include <algorithm>
#include <cmath>

#include "kinematics/support_polygon.h"

namespace nao::motion {
namespace {

constexpr double kGravity = 9.81;
constexpr double kLeastHeight = 0.1;  // m, so that the pendulum's rate stays finite
// How far beyond the soles' edge the capture point must be, and for how long: pushes that the
// ankles catch reach a centimetre over it for a tick or two (measured in the push trials).
constexpr double kOutside = -0.025;  // m
constexpr double kPatience = 0.03;   // s
// A robot that tips has leant; one that only moves its limbs fast has not. rad.
constexpr double kLeastLean = 0.12;
// Walks that took a push, however hard, leant by 0.34 rad at most; of those that fell, 98 of 100
// leant by this much 150 ms or more before the first touch (measured with nao-trial walk-push),
// rad.
constexpr double kWalkingLean = 0.38;

}  // namespace

Eigen::Vector2d calc_capture_point(const RobotState& state) {
  const double height = std::max(kLeastHeight, state.center_of_mass_in_odometry.z());
  return state.center_of_mass_in_odometry.head<2>() +
         std::sqrt(height / kGravity) * state.center_of_mass_velocity_in_odometry.head<2>();
}

bool FallMonitor::update(const RobotState& state, bool steps, double dt) {
  const double tilt = std::acos(std::clamp(state.torso_in_odometry.linear()(2, 2), -1.0, 1.0));
  if (tilt > lying_tilt_) return true;
  if (steps) return tilt > kWalkingLean;
  // The soles lean with a body that tips over their edge.
  const double sole_lean =
      std::acos(std::clamp(std::max(state.left_sole_in_odometry.linear()(2, 2),
                                    state.right_sole_in_odometry.linear()(2, 2)),
                           -1.0, 1.0));
  const double margin =
      margin_in_polygon(state.support_polygon_in_odometry, calc_capture_point(state));
  const bool is_outside = margin < kOutside && sole_lean > kLeastLean;
  time_outside_ = is_outside ? time_outside_ + dt : 0;
  return time_outside_ >= kPatience - 1e-9;
}

}  // namespace nao::motion
