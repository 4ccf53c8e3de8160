#pragma once

#include <Eigen/Geometry>

#include "daemons/motion/walk/pendulum.h"

namespace nao::motion {

/** Estimates position and velocity of the center of mass over the support foot, and the offset
 * between the two sensors that they are estimated from: an observer with constant gains for the
 * linear inverted pendulum
 *
 *     x'' = omega^2 (x - o - p).
 *
 * The pendulum's equation predicts the acceleration from the measured center of pressure p, so that
 * the velocity has less delay than differences of positions with the same noise. The offset o is
 * the excess of the measured position x over p: a tilted mounting of the inertial unit, joint zeros
 * and a wrong center of mass move x by several millimeters. They cannot be distinguished, and the
 * walk needs none of them: only x - o - p accelerates the robot. */
class PendulumEstimator {
 public:
  /** @param max_offset   Bound of the offset, m.
   * @param offset_gain  Fraction of the residual by which the offset changes in each control tick.
   * A constant error e of the offset leaves a residual of e (omega dt)^2 / kVelocityGain: at 1 and
   * an omega of 6 / s the offset settles in 0.36 s. */
  PendulumEstimator(double max_offset, double offset_gain)
      : max_offset_(max_offset), offset_gain_(offset_gain) {}

  /** Starts at rest. @param position  m, in the frame of the support sole. @param zmp  m. */
  void reset(const Eigen::Vector2d& position, const Eigen::Vector2d& zmp) {
    state_ = {position, Eigen::Vector2d::Zero()};
    offset_ = limited(kStandingFraction * (position - zmp));
  }

  /** Starts in a motion, without an offset: the center of pressure is at an edge of the soles. */
  void reset(const PendulumState& state) {
    state_ = state;
    offset_.setZero();
  }

  /** Takes in one measurement.
   * @param position  Position of the center of mass, m. @param zmp  m. @param omega  1/s.
   * @param dt        s since the last measurement. */
  void update(const Eigen::Vector2d& position, const Eigen::Vector2d& zmp, double omega,
              double dt) {
    state_ = advance(state_, zmp + offset_, omega, dt);
    const Eigen::Vector2d residual = position - state_.position;
    state_.position += kPositionGain * residual;
    state_.velocity += kVelocityGain / dt * residual;
    offset_ = limited(offset_ - offset_gain_ * residual);
  }

  /** Changes to the frame of the other foot, which is now the support foot.
   * @param position  Measured, in the new frame, m. @param heading  Heading of the new frame in the
   * old one, rad. */
  void change_frame(const Eigen::Vector2d& position, double heading) {
    state_.position = position;
    state_.velocity = Eigen::Rotation2Dd(-heading) * state_.velocity;
    offset_ = Eigen::Rotation2Dd(-heading) * offset_;
  }

  /** Measured value, with the offset. */
  const PendulumState& state() const { return state_; }
  /** m. */
  const Eigen::Vector2d& offset() const { return offset_; }

 private:
  // Fraction of the residual that corrects the estimate in each control tick. Chosen for encoder
  // steps of 1.5 mrad (0.3 mm at the center of mass) and a velocity that settles in five ticks.
  static constexpr double kPositionGain = 0.6;
  static constexpr double kVelocityGain = 0.15;
  // Fraction of the difference between position and center of pressure at rest that is taken as the
  // offset. Chosen: both sensors have errors of the same size.
  static constexpr double kStandingFraction = 0.5;

  Eigen::Vector2d limited(const Eigen::Vector2d& offset) const {
    const Eigen::Vector2d limit = Eigen::Vector2d::Constant(max_offset_);
    return offset.cwiseMax(-limit).cwiseMin(limit);
  }

  double max_offset_;
  double offset_gain_;
  PendulumState state_;
  Eigen::Vector2d offset_ = Eigen::Vector2d::Zero();
};

}  // namespace nao::motion
