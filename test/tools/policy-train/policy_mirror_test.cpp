#include "tools/policy-train/policy_mirror.h"

#include <gmock/gmock.h>

#include "test/tools/policy-train/small_policy.h"
#include "tools/policy-train/batch_simulation.h"

namespace nao::policy_train {
namespace {

std::vector<float> reflected(const Reflection& reflection, const std::vector<float>& numbers) {
  std::vector<float> result;
  for (size_t i = 0; i < reflection.index.size(); ++i) {
    result.push_back(reflection.sign[i] * numbers[static_cast<size_t>(reflection.index[i])]);
  }
  return result;
}

TEST(PolicyMirror, SwapsLegsAndTurnsLateralNumbers) {
  const PolicyManifest manifest = parse_manifest(kLegs);
  EXPECT_THAT(reflected(reflect_action(t1_model(), manifest), {1, 2, 3, 4, 5, 6, 7, 8}),
              testing::ElementsAre(5, -6, 7, 8, 1, -2, 3, 4));
  std::vector<float> observation(static_cast<size_t>(manifest.num_observations()));
  for (size_t i = 0; i < 10; ++i) observation[i] = static_cast<float>(i + 1);
  observation.back() = 0.5F;
  const std::vector<float> mirrored =
      reflected(reflect_observation(t1_model(), manifest), observation);
  EXPECT_THAT(std::vector<float>(mirrored.begin(), mirrored.begin() + 9),
              testing::ElementsAre(-1, 2, -3, 4, -5, 6, 7, -8, -9));
  // The left hip's pitch is the right one's.
  EXPECT_EQ(mirrored[9], 0);
  EXPECT_EQ(mirrored[13], 10);
  EXPECT_EQ(mirrored.back(), -0.5F);
}

TEST(PolicyMirror, TwiceIsTheSame) {
  for (const char* history :
       {"", "history: {steps: 3}\n", "history: {steps: 3, layout: by_step}\n"}) {
    const PolicyManifest manifest = parse_manifest(
        replaced(replaced(kLegs, "observations:", std::string(history) + "observations:"),
                 "{quantity: phase_sine}", "{quantity: phase_sine, feet: [0, 0.5]}"));
    const Reflection reflection = reflect_observation(t1_model(), manifest);
    std::vector<float> observation;
    for (int i = 0; i < manifest.num_observations(); ++i) {
      observation.push_back(static_cast<float>(i));
    }
    ASSERT_EQ(reflection.index.size(), observation.size());
    EXPECT_NE(reflected(reflection, observation), observation);
    EXPECT_EQ(reflected(reflection, reflected(reflection, observation)), observation);
  }
}

// A robot whose targets are the mirror images of another one's moves as its mirror image.
TEST(PolicyMirror, IsThatOfTheSimulatedRobot) {
  EnvironmentOptions options = options_of(replaced(
      replaced(kLegs, "  - {quantity: phase_sine}\n", ""), "phase: {frequency: 1.5}\n", ""));
  std::array<std::vector<float>, 2> observations;
  const Reflection of_action = reflect_action(*options.model, *options.manifest);
  for (int side = 0; side < 2; ++side) {
    const double sign = side == 0 ? 1 : -1;
    options.command = Eigen::Vector3d(0.1, sign * 0.05, sign * 0.2);
    options.start_spread = 0;
    const PushSchedule pushes(0);
    PolicyEnvironment environment(options, pushes, 1);
    BatchRows rows(*options.manifest, 1);
    const StepOutput output{rows.observations.data(), rows.final_observations.data(),
                            rows.privileged.data(),   rows.terms.data(),
                            rows.terminated.data(),   rows.truncated.data()};
    environment.reset(output);
    for (int k = 0; k < 25; ++k) {
      const float bend = 0.04F * static_cast<float>(k);
      const std::vector<float> action = {bend, bend, bend, 0, 0, bend, 0, 0};
      environment.step(side == 0 ? action.data() : reflected(of_action, action).data(), output);
    }
    observations[static_cast<size_t>(side)] = rows.observations;
  }
  const std::vector<float> expected =
      reflected(reflect_observation(*options.model, *options.manifest), observations[0]);
  EXPECT_THAT(observations[1], testing::Pointwise(testing::FloatNear(0.05F), expected));
  EXPECT_THAT(observations[1],
              testing::Not(testing::Pointwise(testing::FloatNear(0.05F), observations[0])));
}

}  // namespace
}  // namespace nao::policy_train
