#include "tools/nao-trial/lying_start.h"

#include <algorithm>
#include <cmath>

#include "sim/lying_start.h"

namespace nao::trial {
namespace {

constexpr double kStillVelocity = 0.1;  // rad/s
constexpr int kNumStill = 10;           // ticks
constexpr double kLongestWait = 3;      // s
// Time for which a robot that has got up must stand, s: as long as a fall counts as the get-up's
// consequence in motion (FallSupervisor).
constexpr double kStandingTime = 2;
// Tilt of the torso at which it falls, rad. Chosen: above those of walks (kWalkingFallTilt,
// fall_tilt).
constexpr double kToppledTilt = 0.6;
// Fraction of the standing height above which the robot has got up.
constexpr double kUpright = 0.90625;
// Up to this weight and height a push of 4 to 6 N s makes a robot fall; a larger one takes an
// impulse in proportion to its mass and, for the energy to fall over, to the square root of its
// height.
constexpr double kLightMass = 6;     // kg
constexpr double kLowHeight = 0.35;  // m, of the standing torso

}  // namespace

bool knock_over(ClosedLoop& trial, double direction) {
  const double size = trial.model().total_mass() / kLightMass *
                      std::sqrt(trial.model().references().heights.standing / kLowHeight);
  const double impulse = std::max(1.0, size) * trial.random(4, 6);
  const Eigen::Vector3d push(impulse * std::cos(direction), impulse * std::sin(direction), 0);
  // A robot whose push recovery withstands the first one.
  for (const double factor : {1, 2}) {
    trial.world().push(0, 0, factor * push);
    if (trial.run_until([&] { return trial.torso_tilt() > 1.0; }, 5)) return true;
  }
  return false;
}

void lay_down(ClosedLoop& trial, double side) {
  sim::lay_down(trial.world(), 0, side,
                [&trial](double low, double high) { return trial.random(low, high); });
  // The controller treats a robot that was placed as a new one.
  trial.restart_core();
}

LyingStill wait_until_still(ClosedLoop& trial) {
  Eigen::Vector3d up = trial.torso_in_world().linear().row(2);
  int num_still = -1;  // the first look compares with itself
  trial.run_until(
      [&] {
        const Eigen::Vector3d now = trial.torso_in_world().linear().row(2);
        const bool is_still = (now - up).norm() / trial.period() < kStillVelocity;
        up = now;
        num_still = is_still ? num_still + 1 : 0;
        // In this mode it may still lie and wait for its body to come to rest.
        const motion::MotionState& state = trial.core().motion_state();
        const bool gets_up = state.mode == Mode::kGettingUp && state.command_progress > 0;
        return gets_up || num_still >= kNumStill;
      },
      kLongestWait);
  LyingStill lying;
  lying.since = trial.time() - std::max(0, num_still) * trial.period();
  if (std::abs(up.x()) > std::abs(up.y())) {
    lying.side = up.x() < 0 ? "belly" : "back";
  } else {
    lying.side = up.y() < 0 ? "left" : "right";
  }
  return lying;
}

bool has_got_up(ClosedLoop& trial) {
  const MotionReferences& references = trial.model().references();
  const motion::MotionState state = trial.core().motion_state();
  return state.mode == Mode::kHolding && state.posture == references.ready &&
         trial.torso_tilt() < 0.3 && trial.torso_height() > kUpright * references.heights.standing;
}

bool keeps_standing(ClosedLoop& trial) {
  return !trial.run_until([&] { return trial.torso_tilt() > kToppledTilt; }, kStandingTime);
}

}  // namespace nao::trial
