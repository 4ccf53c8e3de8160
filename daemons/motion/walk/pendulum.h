#pragma once

#include <Eigen/Core>
#include <cmath>

namespace nao::motion {

/** The linear inverted pendulum: a mass that stays at one height h above the point on the ground
 * where the floor's force acts (the zero moment point), and is pushed away from it with
 * omega^2 = g / h times its distance.
 *
 * Source: S. Kajita et al., "The 3D linear inverted pendulum mode", IROS 2001; for the divergent
 * component (capture point) J. Englsberger et al., "Three-dimensional bipedal walking control based
 * on divergent component of motion", IEEE T-RO 31(2), 2015. */
struct PendulumState {
  /** Of the centre of mass over the ground, m and m/s. */
  Eigen::Vector2d position = Eigen::Vector2d::Zero();
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();

  /** Divergent component of motion: where the zero moment point must be for the mass to come to
   * rest above it, m. @param omega  1/s. */
  Eigen::Vector2d divergent(double omega) const { return position + velocity / omega; }
};

/** The state some time later with the zero moment point held. @param time  s. */
inline PendulumState advance(const PendulumState& state, const Eigen::Vector2d& zero_moment_point,
                             double omega, double time) {
  const double c = std::cosh(omega * time);
  const double s = std::sinh(omega * time);
  const Eigen::Vector2d offset = state.position - zero_moment_point;
  return {zero_moment_point + c * offset + s / omega * state.velocity,
          omega * s * offset + c * state.velocity};
}

/** Where the zero moment point must be held for a time so that the divergent component goes from
 * one point to another, m. @param time  s, above 0. */
inline Eigen::Vector2d steering_point(const Eigen::Vector2d& from, const Eigen::Vector2d& to,
                                      double omega, double time) {
  const double growth = std::exp(omega * time);
  return (growth * from - to) / (growth - 1);
}

}  // namespace nao::motion
