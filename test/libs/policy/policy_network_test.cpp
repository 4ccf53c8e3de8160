// OpenCV runs what torch.onnx.export writes.
#include "policy/policy_network.h"

#include <gmock/gmock.h>

#include "common/error.h"
#include "policy/policy.h"
#include "test/libs/policy/manifests.h"
#include "test/support/onnx_file.h"

namespace nao {
namespace {

class PolicyNetworkTest : public testing::Test {
 protected:
  std::string error_of(int num_observations, int num_actions) const {
    try {
      load_policy_network(file_, num_observations, num_actions);
    } catch (const ModelError& error) {
      return error.what();
    }
    return "";
  }
  const TemporaryFolder folder_;
  const std::filesystem::path file_ = folder_.path() / "policy.onnx";
};

TEST_F(PolicyNetworkTest, ComputesLayersAndActivations) {
  struct {
    const char* name;
    float (*function)(float);
  } activations[] = {{"Elu", [](float x) { return x > 0 ? x : std::expm1(x); }},
                     {"Relu", [](float x) { return std::max(0.0F, x); }},
                     {"Tanh", [](float x) { return std::tanh(x); }}};
  for (const auto& activation : activations) {
    for (const int opset : {9, 11, 13, 17}) {
      OnnxFile::write(
          file_, 3, {{{1, 0, 0, 0, -2, 0}, {0.5F, 0}, activation.name}, {{1, 1, 0, 1}, {0, 1}, ""}},
          opset);
      const auto network = load_policy_network(file_, 3, 2);
      std::vector<float> action;
      EXPECT_GE(network->run({1, 0.25F, 9}, action), 0);
      const float a = activation.function(1.5F);
      const float b = activation.function(-0.5F);
      EXPECT_THAT(action,
                  testing::Pointwise(testing::FloatNear(1e-5F), std::vector<float>{a + b, b + 1}))
          << activation.name << " of opset " << opset;
    }
  }
}

TEST_F(PolicyNetworkTest, RefusesOtherNumbersThanTheManifests) {
  OnnxFile::write(file_, 3, {OnnxFile::constant(3, {0, 0})});
  EXPECT_EQ(error_of(3, 2), "");
  EXPECT_THAT(error_of(4, 2),
              testing::EndsWith("has 3 inputs, but the manifest lists 4 observations"));
  EXPECT_THAT(error_of(3, 1), testing::EndsWith("has 2 outputs, but the manifest lists 1 joints"));
}

TEST_F(PolicyNetworkTest, RefusesAFileThatIsMissingOrNoNetwork) {
  EXPECT_THAT(error_of(3, 2), testing::EndsWith("is missing"));
  write_text(file_, "no network");
  EXPECT_THAT(error_of(3, 2), testing::HasSubstr("cannot run it"));
  OnnxFile::write(file_, 3, {OnnxFile::constant(3, {0, 0})});
  write_text(file_, read_text(file_).substr(0, 60));
  EXPECT_THAT(error_of(3, 2), testing::HasSubstr("policy.onnx"));
}

TEST_F(PolicyNetworkTest, APolicyWithAFaultSaysWhatItIs) {
  write_text(folder_.path() / kPolicyFile, kSmallManifest);
  const auto fault = [&] {
    return Policy::load(t1_model(), folder_.path() / kPolicyFile).find_fault();
  };
  EXPECT_THAT(fault(), testing::EndsWith("policy.onnx: is missing"));
  OnnxFile::write(file_, 8, {OnnxFile::constant(8, {0, 0})});
  const Policy policy = Policy::load(t1_model(), folder_.path() / kPolicyFile);
  EXPECT_EQ(policy.find_fault(), "");
  std::filesystem::remove(file_);
  EXPECT_THAT(policy.find_fault(), testing::EndsWith("policy.onnx: was removed"));
}

}  // namespace
}  // namespace nao
