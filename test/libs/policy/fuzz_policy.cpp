// Input of libFuzzer: the text of a policy's manifest. What is accepted must give an observation of
// the size that it says.
#include <cstdint>
#include <cstdlib>

#include "common/error.h"
#include "policy/observation_builder.h"
#include "test/libs/policy/manifests.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  try {
    const nao::PolicyManifest manifest =
        nao::parse_manifest(std::string(reinterpret_cast<const char*>(data), size));
    nao::PolicyInput input;
    input.joint_position.resize(static_cast<size_t>(nao::t1_model().num_motors()));
    input.joint_velocity = input.joint_position;
    nao::ObservationBuilder builder(manifest);
    const std::vector<float> action(manifest.joints.size());
    const auto count = static_cast<size_t>(manifest.num_observations());
    if (builder.build(input, action).size() != count) std::abort();
  } catch (const nao::Error&) {
    return 0;
  }
  return 0;
}
