#include "tools/policy-train/batch_simulation.h"

#include <atomic>
#include <thread>

namespace nao::policy_train {
namespace {

size_t count_of(int rows, int columns) {
  return static_cast<size_t>(rows) * static_cast<size_t>(columns);
}

}  // namespace

BatchRows::BatchRows(const PolicyManifest& manifest, int size)
    : actions(count_of(size, manifest.num_actions())),
      observations(count_of(size, manifest.num_observations())),
      final_observations(observations.size()),
      privileged(count_of(size, kNumPrivileged)),
      terms(count_of(size, kNumRewardTerms)),
      terminated(count_of(size, 1)),
      truncated(count_of(size, 1)) {}

BatchSimulation::BatchSimulation(const EnvironmentOptions& options, int size, int num_threads,
                                 uint64_t seed)
    : options_(options),
      num_threads_(num_threads),
      pushes_(options.push),
      environments_(static_cast<size_t>(size)) {
  this->seed(seed);
}

void BatchSimulation::seed(uint64_t seed) {
  pushes_ = PushSchedule(options_.push);
  for (auto& environment : environments_) {
    environment = std::make_unique<PolicyEnvironment>(options_, pushes_, seed++);
  }
}

StepOutput BatchSimulation::output_of(const BatchArrays& arrays, int i) const {
  StepOutput output;
  const int num_observations = options_.manifest->num_observations();
  output.observation = arrays.observations + i * num_observations;
  output.final_observation = arrays.final_observations + i * num_observations;
  output.privileged = arrays.privileged + i * kNumPrivileged;
  output.reward_terms = arrays.reward_terms + i * kNumRewardTerms;
  output.terminated = arrays.terminated + i;
  output.truncated = arrays.truncated + i;
  return output;
}

// Each thread takes the next environment: episodes that begin with a fall take longer.
template <class Work>
void BatchSimulation::for_each(Work work) {
  std::atomic<int> next{0};
  const auto run = [&] {
    for (int i = next++; i < size(); i = next++) work(i);
  };
  std::vector<std::jthread> threads;
  for (int i = 1; i < num_threads_; ++i) threads.emplace_back(run);
  run();
}

void BatchSimulation::reset(const BatchArrays& arrays) {
  for_each([&](int i) { environments_[static_cast<size_t>(i)]->reset(output_of(arrays, i)); });
}

void BatchSimulation::step(const BatchArrays& arrays) {
  for_each([&](int i) {
    environments_[static_cast<size_t>(i)]->step(
        arrays.actions + i * options_.manifest->num_actions(), output_of(arrays, i));
  });
  // In this order whatever thread stepped them.
  for (const auto& environment : environments_) {
    if (const auto& outcome = environment->pushes().outcome()) {
      pushes_.learn(outcome->push, outcome->fallen);
    }
  }
}

}  // namespace nao::policy_train
