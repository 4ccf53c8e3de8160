#pragma once

#include <Eigen/Geometry>

#include "daemons/motion/walk/pendulum.h"

namespace nao::motion {

/** Estimates position and velocity of the center of mass over the support foot: an observer with
 * constant gains for the linear inverted pendulum.
 *
 * The pendulum's equation predicts the acceleration from the measured center of pressure, so that
 * the velocity has less delay than differences of positions with the same noise. */
class PendulumEstimator {
 public:
  /** Starts at rest. @param position  m, in the frame of the support sole. */
  void reset(const Eigen::Vector2d& position) { state_ = {position, Eigen::Vector2d::Zero()}; }

  /** Takes in one measurement.
   * @param position  Of the center of mass, m. @param zmp  m. @param omega  1/s.
   * @param dt        s since the last measurement. */
  void update(const Eigen::Vector2d& position, const Eigen::Vector2d& zmp, double omega,
              double dt) {
    state_ = advance(state_, zmp, omega, dt);
    const Eigen::Vector2d residual = position - state_.position;
    state_.position += kPositionGain * residual;
    state_.velocity += kVelocityGain / dt * residual;
  }

  /** Changes to the frame of the other foot, which is the support foot from now on.
   * @param position  Measured, in the new frame, m. @param heading  Of the new frame in the old
   * one, rad. */
  void change_frame(const Eigen::Vector2d& position, double heading) {
    state_.position = position;
    state_.velocity = Eigen::Rotation2Dd(-heading) * state_.velocity;
  }

  const PendulumState& state() const { return state_; }

 private:
  // Fraction of the residual that corrects the estimate in each control tick. Chosen for encoder
  // steps of 1.5 mrad (0.3 mm at the center of mass) and a velocity that settles in five ticks.
  static constexpr double kPositionGain = 0.6;
  static constexpr double kVelocityGain = 0.15;

  PendulumState state_;
};

}  // namespace nao::motion
