#pragma once

#include <memory>
#include <vector>

#include "sim/compliant_contact.h"
#include "sim/contact_detector.h"
#include "sim/engine.h"

namespace nao::sim {

/** Simbody's multibody dynamics and constraint solver in semi-explicit Euler substeps, with
 * compliant contacts (CompliantContact), for comparisons.
 *
 * The rotors' reflected inertia, which Simbody's joints do not have, is exact: the acceleration
 * that M + J gives, with Simbody's mass matrix M, is computed first, and the rotors' torques -J u'
 * are applied to Simbody's system, whose own accelerations then are u'. The damping of a robot's
 * contacts is made implicit in the same way (ContactDamping). */
class SimbodyEngine : public Engine {
 public:
  /** @param options, bodies  Must outlive this. */
  SimbodyEngine(const SceneFile& scene, const WorldOptions& options, MovingBodies& bodies);
  ~SimbodyEngine() override;

  const char* name() const override { return "simbody"; }
  void add_robot() override;
  void step() override;
  void reset() override;
  void forget_contacts_of_robot(int robot) override;
  void forget_contacts_of_ball() override;

  int64_t num_steps() const override { return num_steps_; }
  const std::vector<Contact>& contacts() const override { return contacts_; }
  int64_t num_dropped_contacts() const override { return candidates_.num_dropped(); }

 private:
  class RobotSystem;
  class BallSystem;

  /** Finds the contact candidates of all bodies in their current state. */
  const std::vector<ContactCandidate>& find_candidates();
  void collect_contacts();
  /** Number of a substep of this step since the start. */
  int64_t number_of(int substep) const;

  ContactDetector detector_;
  CompliantContact law_;
  /** All bodies: they are stepped together. */
  Island whole_;
  ContactCandidates candidates_;
  std::vector<std::unique_ptr<RobotSystem>> robots_;
  std::unique_ptr<BallSystem> ball_;
  std::vector<Contact> contacts_;
  int64_t num_steps_ = 0;
};

}  // namespace nao::sim
