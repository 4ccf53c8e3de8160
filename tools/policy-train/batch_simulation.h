#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "tools/policy-train/policy_environment.h"

namespace nao::policy_train {

/** Arrays of a batch, one row for each environment; see StepOutput. */
struct BatchArrays {
  /** (size x num_actions). */
  const float* actions = nullptr;
  float* observations = nullptr;
  float* final_observations = nullptr;
  float* privileged = nullptr;
  float* reward_terms = nullptr;
  uint8_t* terminated = nullptr;
  uint8_t* truncated = nullptr;
};

/** The memory of a batch's arrays. */
class BatchRows {
 public:
  BatchRows(const PolicyManifest& manifest, int size);

  BatchArrays arrays() {
    return {actions.data(), observations.data(), final_observations.data(), privileged.data(),
            terms.data(),   terminated.data(),   truncated.data()};
  }

  std::vector<float> actions;
  std::vector<float> observations;
  std::vector<float> final_observations;
  std::vector<float> privileged;
  std::vector<float> terms;
  std::vector<uint8_t> terminated;
  std::vector<uint8_t> truncated;
};

/** Environments that are stepped together, on several threads. The result does not depend on the
 * number of threads. */
class BatchSimulation {
 public:
  /** Environment i has the seed `seed` + i. @param num_threads  1 or more.
   * @throws ConfigError, ModelError  as PolicyEnvironment does. */
  BatchSimulation(const EnvironmentOptions& options, int size, int num_threads, uint64_t seed);

  /** Other robots: their draws and episodes are those of a batch made with this seed. */
  void seed(uint64_t seed);
  int size() const { return static_cast<int>(environments_.size()); }
  /** Begins an episode in each environment; writes observations and privileged. */
  void reset(const BatchArrays& arrays);
  /** One step of each environment; whose episode ends begins a new one. Within an episode it
   * allocates nothing but the threads, with the engine "fast". */
  void step(const BatchArrays& arrays);

 private:
  template <class Work>
  void for_each(Work work);
  StepOutput output_of(const BatchArrays& arrays, int i) const;

  EnvironmentOptions options_;
  int num_threads_;
  PushSchedule pushes_;
  std::vector<std::unique_ptr<PolicyEnvironment>> environments_;
};

}  // namespace nao::policy_train
