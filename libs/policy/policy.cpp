#include "policy/policy.h"

#include <fmt/core.h>

#include <algorithm>

#include "common/error.h"
#include "robot_model/policy_files.h"

namespace nao {
namespace {

// Runs of the network when it is loaded; the fastest counts, for others may be late by the
// machine's other work.
constexpr int kNumTrials = 10;

/** Fastest of some runs, s. */
double measure(PolicyNetwork& network, int num_observations) {
  const std::vector<float> observation(static_cast<size_t>(num_observations));
  std::vector<float> action;
  double fastest = network.run(observation, action);
  for (int i = 1; i < kNumTrials; ++i)
    fastest = std::min(fastest, network.run(observation, action));
  return fastest;
}

}  // namespace

Policy Policy::load(const RobotModel& model, const std::filesystem::path& manifest_file) {
  Policy policy;
  policy.manifest_file = manifest_file;
  policy.name = manifest_file.parent_path().filename().string();
  try {
    policy.manifest = PolicyManifest::load(model, manifest_file);
    const PolicyManifest& manifest = *policy.manifest;
    policy.network = load_policy_network(manifest_file.parent_path() / manifest.network,
                                         manifest.num_observations(), manifest.num_actions());
    const double time = measure(*policy.network, manifest.num_observations());
    if (time > manifest.period / 2) {
      policy.fault = fmt::format(
          "{}: an inference takes {:.0f} ms here, more than half of a step of {:.0f} ms",
          manifest.network, 1e3 * time, 1e3 * manifest.period);
    }
  } catch (const Error& error) {
    policy.fault = error.what();
  }
  return policy;
}

std::string Policy::find_fault() const {
  if (!fault.empty()) return fault;
  if (!std::filesystem::is_regular_file(manifest_file)) {
    return manifest_file.string() + ": was removed";
  }
  const std::filesystem::path file = manifest_file.parent_path() / manifest->network;
  return std::filesystem::is_regular_file(file) ? "" : file.string() + ": was removed";
}

std::vector<Policy> load_policies(const RobotModel& model) {
  std::vector<Policy> policies;
  for (const auto& file : find_policy_files(model.folder())) {
    policies.push_back(Policy::load(model, file));
  }
  return policies;
}

}  // namespace nao
