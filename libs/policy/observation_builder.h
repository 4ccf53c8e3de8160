#pragma once

#include <Eigen/Core>
#include <deque>
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

/** Builds a policy's observation from what the robot measures, as its manifest says. */
class ObservationBuilder {
 public:
  /** @param manifest  Must outlive this. */
  explicit ObservationBuilder(const PolicyManifest& manifest);

  /** Forgets all steps. */
  void reset();

  /** One step. @param phase  Cycles. @param last_action  Of the step before, (num_actions()).
   * @return (num_observations()), valid until the next call. */
  const std::vector<float>& build(const PolicyInput& input, double phase,
                                  const std::vector<float>& last_action);

 private:
  /** The scaled numbers of one step. */
  std::vector<float> calc_term(const PolicyTerm& term, const PolicyInput& input, double phase,
                               const std::vector<float>& last_action) const;

  const PolicyManifest* manifest_;
  /** Steps of each term, the oldest first. */
  std::vector<std::deque<std::vector<float>>> steps_;
  std::vector<float> observation_;
};

}  // namespace nao
