#pragma once

#include <optional>
#include <string>
#include <vector>

#include "policy/observation_builder.h"
#include "policy/policy_manifest.h"
#include "policy/policy_network.h"
#include "robot_model/robot_model.h"

namespace nao {

/** Runs a policy: at its rate, from what the robot measures to joint targets. Checks what comes
 * out.
 *
 * No clock: the network says how long it took. */
class PolicyRunner {
 public:
  /** All must outlive this. */
  PolicyRunner(const RobotModel& model, const PolicyManifest& manifest, PolicyNetwork& network);

  /** Begins anew: no history, action 0, the phase at its start. @param lead  In addition, cycles.
   */
  void start(double lead = 0);

  /** One control step. @param dt  Time since the last one, s.
   * @return Why the policy must not go on; nothing if it may. */
  std::optional<std::string> step(const PolicyInput& input, double dt);

  /** Moves the phase to its start. @param lead  In addition, cycles. */
  void restart_phase(double lead) { builder_.restart_phase(lead); }

  /** Targets of the manifest's joints, rad, in its order. */
  const std::vector<double>& targets() const { return targets_; }
  const std::vector<float>& observation() const { return observation_; }
  const std::vector<float>& action() const { return action_; }
  /** Processor time of the last inference, s. */
  double inference_time() const { return inference_time_; }
  /** Steps of the policy since start(). */
  int64_t num_steps() const { return num_steps_; }

 private:
  std::optional<std::string> find_fault();

  const RobotModel* model_;
  const PolicyManifest* manifest_;
  PolicyNetwork* network_;
  ObservationBuilder builder_;
  std::vector<float> observation_;
  std::vector<float> action_;
  std::vector<double> targets_;
  std::vector<double> last_targets_;
  /** Successive steps in which the target of each joint moved faster than its motor. */
  std::vector<int> num_fast_steps_;
  int num_slow_inferences_ = 0;
  double inference_time_ = 0;
  /** Time until the next step of the policy, s. */
  double time_left_ = 0;
  int64_t num_steps_ = 0;
};

}  // namespace nao
