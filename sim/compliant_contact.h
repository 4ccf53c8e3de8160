#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "sim/contact_detector.h"
#include "sim/moving_bodies.h"
#include "sim/world_options.h"

namespace nao::sim {

/** A contact force, and how it changes with the velocity of its surfaces. */
struct CompliantForce {
  /** On surface a, N, in W. */
  Eigen::Vector3d on_a = Eigen::Vector3d::Zero();
  /** -dF/dv for the velocity v of a relative to b, N s/m, in W: symmetric, not negative. */
  Eigen::Matrix3d damping = Eigen::Matrix3d::Zero();
};

/** A contact law for engines that integrate forces: the force as a function of the present state.
 *
 * Normal: Hunt and Crossley's law with a linear spring, k x (1 + 3/2 c x') (K. H. Hunt, F. R. E.
 * Crossley, "Coefficient of restitution interpreted as damping in vibroimpact", 1975), without
 * adhesion.
 *
 * Tangential: Coulomb's friction with elastic bristles (P. R. Dahl, "A solid friction model",
 * 1968): a spring and a damper between the surfaces, whose force stays within Coulomb's cone. The
 * spring's deflection is kept in the ContactMemory, so that a sticking contact does not creep, and
 * is cut where the spring alone would exceed the cone: the law of the fast engine
 * (ContactAssembler). A friction that is a function of the sliding speed alone creeps, or is so
 * steep near rest that an explicit integrator turns it around at its full strength in every step.
 */
class CompliantContact {
 public:
  /** @param bodies, options  Must outlive this. @param substep  Substep of the integrator, s. */
  CompliantContact(const MovingBodies& bodies, const WorldOptions& options, double substep)
      : bodies_(bodies), options_(options), substep_(substep) {}

  /** @param contact  Its ContactMemory is changed.
   * @param substep  Number of the integrator's substep that the state belongs to, rising by 1 while
   * the contact lasts. The deflection of the spring moves on when it rises: further calls with the
   * same number and state give the same force. */
  CompliantForce force(const ContactCandidate& contact, int64_t substep) const;

 private:
  Eigen::Vector3d velocity_of(const Surface& surface, int body, const Eigen::Vector3d& point) const;

  const MovingBodies& bodies_;
  const WorldOptions& options_;
  double substep_;
};

}  // namespace nao::sim
