#include "daemons/motion/falls/fall_monitor.h"

#include <algorithm>
#include <cmath>

#include "common/constants.h"
#include "kinematics/support_polygon.h"

namespace nao::motion {
namespace {

// Least height of the center of mass, m: keeps the pendulum's frequency finite for a robot that
// lies.
constexpr double kMinHeight = 0.1;
// Margin of the capture point to the edge of the support polygon, m, and the time for which it must
// be below this, s. Pushes from which the ankles recover bring it a centimeter outside for one or
// two steps (measured: nao-trial push-course).
constexpr double kFallMargin = -0.025;
constexpr double kFallTime = 0.03;
// Least tilt of the flatter sole, rad: a body that tips over the edge of its soles tilts them, but
// one that only moves its limbs fast does not. Chosen: twice the angle at which TippingGuard calls
// a sole flat.
constexpr double kMinSoleTilt = 0.12;
// Slack of a sum of time steps, s.
constexpr double kRounding = 1e-9;

/** Angle between the z axis of a rotation and vertical, rad. */
double calc_tilt(double cosine) {
  return std::acos(std::clamp(cosine, -1.0, 1.0));
}

}  // namespace

Eigen::Vector2d calc_capture_point(const RobotState& state) {
  // Capture point c + c' sqrt(h / g) of the linear inverted pendulum.
  const double height = std::max(kMinHeight, state.center_of_mass_in_odometry.z());
  return state.center_of_mass_in_odometry.head<2>() +
         std::sqrt(height / kGravity) * state.center_of_mass_velocity_in_odometry.head<2>();
}

bool FallMonitor::update(const RobotState& state, bool is_walking, double dt, double walking_tilt) {
  const double tilt = calc_tilt(state.torso_in_odometry.linear()(2, 2));
  if (tilt > lying_tilt_) return true;
  if (is_walking) return tilt > walking_tilt;
  const double sole_tilt = calc_tilt(std::max(state.left_sole_in_odometry.linear()(2, 2),
                                              state.right_sole_in_odometry.linear()(2, 2)));
  const double margin =
      margin_in_polygon(state.support_polygon_in_odometry, calc_capture_point(state));
  // Without a support polygon the margin is NaN, so that a robot in the air is not considered to
  // fall.
  const bool is_outside = margin < kFallMargin && sole_tilt > kMinSoleTilt;
  time_outside_ = is_outside ? time_outside_ + dt : 0;
  return time_outside_ >= kFallTime - kRounding;
}

}  // namespace nao::motion
