#include "sim/compliant_contact.h"

#include <algorithm>

#include "sim/contact_assembler.h"

namespace nao::sim {
namespace {

using Eigen::Vector3d;

/** Hunt and Crossley's dissipation, s/m. Robots: the damping under a robot of
 * Materials::kSpringMass on four points is then that of the fast engine, Materials::contact_damping
 * = 3/2 c m g / 4. */
constexpr double kDissipation = 6.8;
/** Ball: chosen, since its shell is elastic. */
constexpr double kBallDissipation = 0.5;
/** Damping of the ball's static friction, N s/m: small, since a ball is integrated explicitly.
 * Chosen: a third of the critical damping of its tangential spring. */
constexpr double kBallTangentDamping = 10;

}  // namespace

Vector3d CompliantContact::velocity_of(const Surface& surface, int body,
                                       const Vector3d& point) const {
  if (surface.kind == Surface::Kind::kRobot) {
    return bodies_.robots[surface.robot]->dynamics().velocity_at(body, point);
  }
  if (surface.kind == Surface::Kind::kBall) return bodies_.ball->velocity_at(point);
  return Vector3d::Zero();
}

CompliantForce CompliantContact::force(const ContactCandidate& contact, int64_t substep) const {
  CompliantForce result;
  const double depth = -contact.proximity.distance;
  if (!(depth > 0)) return result;
  const Vector3d& normal = contact.proximity.normal;
  const Vector3d& point = contact.proximity.point;
  const Vector3d relative =
      velocity_of(contact.a, contact.body_a, point) - velocity_of(contact.b, contact.body_b, point);
  // Positive while the surfaces separate; the factor 1 - 3/2 c v is clipped at 0, since a fast
  // separation would pull.
  const double opening = normal.dot(relative);
  const bool is_ball = contact.a.kind == Surface::Kind::kBall;
  const double dissipation = is_ball ? kBallDissipation : kDissipation;
  const double spring = options_.materials.contact_stiffness * depth;
  const double pressing = spring * std::max(0.0, 1 - 1.5 * dissipation * opening);

  ContactMemory& memory = *contact.memory;
  Vector3d& deflection = memory.spring_deflection;
  const Vector3d sliding = relative - opening * normal;
  const int64_t passed = substep - memory.last_step;
  // A contact that was open in the last substep starts without deflection.
  if (passed > 1) deflection.setZero();
  // If two bodies are integrated one after the other, the first one moves the spring.
  if (passed == 1) deflection += substep_ * sliding;
  memory.last_step = std::max(memory.last_step, substep);
  // The normal may have turned.
  deflection -= normal.dot(deflection) * normal;

  const double stiffness = options_.materials.tangent_stiffness;
  double damping = is_ball ? kBallTangentDamping : options_.materials.tangent_damping;
  const double limit =
      friction_between(contact.a, contact.b, bodies_, options_.materials) * pressing;
  if (const double length = deflection.norm(); stiffness * length > limit) {
    deflection *= limit / (stiffness * length);
  }
  Vector3d friction = -stiffness * deflection - damping * sliding;
  if (const double force = friction.norm(); force > limit) {
    friction *= limit / force;
    damping *= limit / force;
  }
  result.on_a = pressing * normal + friction;
  const double normal_damping = pressing > 0 ? 1.5 * dissipation * spring : 0;
  result.damping = damping * Eigen::Matrix3d::Identity() +
                   (normal_damping - damping) * normal * normal.transpose();
  return result;
}

}  // namespace nao::sim
