#pragma once

#include <Eigen/Geometry>

#include "daemons/motion/walk/pendulum.h"

namespace nao::motion {

/** Position and velocity of the centre of mass over the standing foot, from its measured positions
 * and the pendulum's law: an observer with constant gains.
 *
 * The law knows the acceleration from where the floor's force acts, so that the velocity has far
 * less lag than a difference of positions of the same noise. */
class PendulumEstimator {
 public:
  /** Starts at rest. @param position  m, in the frame of the standing sole. */
  void reset(const Eigen::Vector2d& position) { state_ = {position, Eigen::Vector2d::Zero()}; }

  /** Takes in one measurement.
   * @param position           Of the centre of mass, m. @param zero_moment_point  m.
   * @param omega              1/s. @param dt  s since the last one. */
  void update(const Eigen::Vector2d& position, const Eigen::Vector2d& zero_moment_point,
              double omega, double dt) {
    state_ = advance(state_, zero_moment_point, omega, dt);
    const Eigen::Vector2d surprise = position - state_.position;
    state_.position += kPositionGain * surprise;
    state_.velocity += kVelocityGain / dt * surprise;
  }

  /** The other foot stands from now on.
   * @param position  Measured, in its frame, m. @param heading  Of its frame in the old one, rad.
   */
  void change_frame(const Eigen::Vector2d& position, double heading) {
    state_.position = position;
    state_.velocity = Eigen::Rotation2Dd(-heading) * state_.velocity;
  }

  const PendulumState& state() const { return state_; }

 private:
  // Share of a surprise that moves the estimate. Chosen for encoder steps of 1.5 mrad (0.3 mm at
  // the centre of mass) and a velocity that settles in five ticks.
  static constexpr double kPositionGain = 0.6;
  static constexpr double kVelocityGain = 0.15;

  PendulumState state_;
};

}  // namespace nao::motion
