#pragma once

#include <Eigen/Core>
#include <cmath>

namespace nao::motion {

/** State of the linear inverted pendulum: a center of mass x at constant height h over the ground,
 * driven by the zero moment point (ZMP) p:
 *
 *     x'' = omega^2 (x - p),  omega = sqrt(g / h).
 *
 * Its divergent component of motion (DCM, also called the capture point) is
 *
 *     xi = x + x' / omega,  with  xi' = omega (xi - p)  and  x' = -omega (x - xi):
 *
 * x converges to xi without control, xi diverges from p. A ZMP held at xi brings the pendulum to
 * rest there.
 *
 * Source: S. Kajita et al., "Biped walking pattern generation by using preview control of
 * zero-moment point", ICRA 2003 (pendulum, ZMP); J. Pratt et al., "Capture point: a step toward
 * humanoid push recovery", Humanoids 2006; J. Englsberger, C. Ott, A. Albu-Schäffer,
 * "Three-dimensional bipedal walking control based on divergent component of motion", IEEE T-RO
 * 31(2), 2015. */
struct PendulumState {
  /** Center of mass over the ground, m and m/s. */
  Eigen::Vector2d position = Eigen::Vector2d::Zero();
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();

  /** Divergent component of motion, m. @param omega  1/s. */
  Eigen::Vector2d dcm(double omega) const { return position + velocity / omega; }
};

/** State after a time with the ZMP held: the closed-form solution of the pendulum's equation.
 * @param zmp  m. @param omega  1/s. @param time  s. */
inline PendulumState advance(const PendulumState& state, const Eigen::Vector2d& zmp, double omega,
                             double time) {
  const double c = std::cosh(omega * time);
  const double s = std::sinh(omega * time);
  const Eigen::Vector2d offset = state.position - zmp;
  return {zmp + c * offset + s / omega * state.velocity, omega * s * offset + c * state.velocity};
}

/** DCM after a time with the ZMP held: xi(t) = p + e^(omega t) (xi - p).
 * @param time  s; negative: the DCM before. */
inline Eigen::Vector2d advance_dcm(const Eigen::Vector2d& dcm, const Eigen::Vector2d& zmp,
                                   double omega, double time) {
  return zmp + std::exp(omega * time) * (dcm - zmp);
}

/** ZMP, m, that when held for a time moves the DCM from one point to another.
 * @param time  s, above 0. */
inline Eigen::Vector2d zmp_between_dcms(const Eigen::Vector2d& from, const Eigen::Vector2d& to,
                                        double omega, double time) {
  const double growth = std::exp(omega * time);
  return (growth * from - to) / (growth - 1);
}

}  // namespace nao::motion
