#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "common/constants.h"
#include "daemons/motion/walk/gait.h"
#include "daemons/motion/walk/pendulum.h"
#include "kinematics/pose2.h"

namespace nao::motion {

/** Reference trajectory of the center of mass over the support foot: a linear inverted pendulum
 * whose input is the zero moment point that the walk chooses in every tick.
 *
 * follow() moves the reference towards the measured state, so that a persistent tracking error
 * changes the plan instead of loading the edge of the sole. */
class ComReference {
 public:
  explicit ComReference(const Gait& gait) : gains_(&gait.feedback) {}

  /** Begins at rest. @param com  In the support frame, m. @param height  Over the ground, m. */
  void start(const Eigen::Vector2d& com, double height) {
    rest_at(com);
    omega_ = std::sqrt(kGravity / height);
  }

  /** Puts reference and ZMP at rest in a point, m. */
  void rest_at(const Eigen::Vector2d& com) {
    state_ = {com, Eigen::Vector2d::Zero()};
    zmp_ = com;
  }

  /** Continues a motion. */
  void start_at(const PendulumState& state) { state_ = state; }

  /** Moves towards the measured state with rates com_position_gain and com_velocity_gain. */
  void follow(const PendulumState& measured, double dt) {
    state_.position +=
        std::min(1.0, gains_->com_position_gain * dt) * (measured.position - state_.position);
    state_.velocity +=
        std::min(1.0, gains_->com_velocity_gain * dt) * (measured.velocity - state_.velocity);
  }

  /** Sets the input from now on, m, in the support frame. */
  void set_zmp(const Eigen::Vector2d& zmp) { zmp_ = zmp; }

  /** One tick. */
  void advance(double dt) { state_ = motion::advance(state_, zmp_, omega_, dt); }

  /** Re-expresses everything in another frame. @param to_new  Old frame seen from the new one. */
  void change_frame(const Pose2& to_new) {
    state_.position = to_new * state_.position;
    state_.velocity = to_new.rotate(state_.velocity);
    zmp_ = to_new * zmp_;
  }

  const PendulumState& state() const { return state_; }
  const Eigen::Vector2d& zmp() const { return zmp_; }
  /** Natural frequency of the pendulum, 1/s. */
  double omega() const { return omega_; }
  Eigen::Vector2d dcm() const { return state_.dcm(omega_); }

  /** Tracking error: measured DCM minus the reference's, m. */
  Eigen::Vector2d dcm_error(const PendulumState& measured) const {
    return measured.dcm(omega_) - dcm();
  }

 private:
  const Gait::Feedback* gains_;
  PendulumState state_;
  Eigen::Vector2d zmp_ = Eigen::Vector2d::Zero();
  double omega_ = 0;
};

}  // namespace nao::motion
