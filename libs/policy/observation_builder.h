#pragma once

#include <Eigen/Core>
#include <vector>

#include "policy/policy_manifest.h"

namespace nao {

/** What the robot measures in one step of a policy. */
struct PolicyInput {
  /** Torso frame: rad/s; m/s; and the unit vector that points down. */
  Eigen::Vector3d angular_velocity = Eigen::Vector3d::Zero();
  Eigen::Vector3d linear_velocity = Eigen::Vector3d::Zero();
  Eigen::Vector3d projected_gravity = -Eigen::Vector3d::UnitZ();
  /** m/s ahead and to the left, rad/s. */
  Eigen::Vector3d command = Eigen::Vector3d::Zero();
  /** rad and rad/s, motor order. */
  std::vector<double> joint_position;
  std::vector<double> joint_velocity;
};

/** Builds a policy's observation, step by step, from what the robot measures, as its manifest says.
 * It allocates only when it is constructed. */
class ObservationBuilder {
 public:
  /** @param manifest  Must outlive this. */
  explicit ObservationBuilder(const PolicyManifest& manifest);

  /** Forgets all steps; the phase is at its start. @param lead  In addition, cycles. */
  void reset(double lead = 0);

  /** One step, which moves the phase on unless it is the first. @param last_action  Of the step
   * before, (num_actions()). @return (num_observations()), valid until the next call. */
  const std::vector<float>& build(const PolicyInput& input, const std::vector<float>& last_action);

  /** Moves the phase to its start. @param lead  In addition, cycles. */
  void restart_phase(double lead);

  /** Phase of the gait in the last step, cycles, 0 to 1. */
  double phase() const { return phase_; }

 private:
  void advance_phase(const PolicyInput& input);
  /** Writes the scaled numbers of one step, (term.size). */
  void calc_term(const PolicyTerm& term, const PolicyInput& input,
                 const std::vector<float>& last_action, float* scaled) const;

  const PolicyManifest* manifest_;
  /** Steps of each term, (num_steps x size), the oldest first. */
  std::vector<std::vector<float>> steps_;
  std::vector<float> observation_;
  double phase_ = 0;
  bool has_begun_ = false;
};

}  // namespace nao
