// Layouts of public trainers, number by number: docs/policies.md names them.
#include "policy/observation_builder.h"

#include <gmock/gmock.h>

#include <cmath>

#include "test/libs/policy/manifests.h"

namespace nao {
namespace {

PolicyInput input_of_t1() {
  PolicyInput input;
  input.angular_velocity = {0.1, 0.2, 0.3};
  input.projected_gravity = {0.01, -0.02, -0.99};
  input.command = {0.5, 0.1, -0.4};
  input.joint_position.assign(static_cast<size_t>(t1_model().num_motors()), 0.0);
  input.joint_velocity = input.joint_position;
  const auto knee = static_cast<size_t>(t1_model().find_motor("Left_Knee_Pitch"));
  input.joint_position[knee] = 0.5;
  input.joint_velocity[knee] = 2;
  return input;
}

std::vector<float> build(PolicyManifest manifest, const PolicyInput& input, double phase = 0) {
  manifest.phase_start = phase;
  ObservationBuilder builder(manifest);
  return builder.build(input, std::vector<float>(manifest.joints.size(), 0.25F));
}

constexpr const char* kJoints = R"(joints:
  - {name: Left_Knee_Pitch, default: 0.4}
command: {vx: [-1, 1], vy: [-1, 1], wz: [-1, 1]}
)";

TEST(ObservationBuilder, BuildsTheLayoutOfUnitreeRlGym) {
  const PolicyManifest manifest = parse_manifest(std::string(R"(kind: walk
network: a.onnx
rate: 50
phase: {frequency: 1.25}
observations:
  - {quantity: angular_velocity, scale: 0.25}
  - {quantity: projected_gravity}
  - {quantity: velocity_command, scale: [2, 2, 0.25]}
  - {quantity: joint_position}
  - {quantity: joint_velocity, scale: 0.05}
  - {quantity: last_action}
  - {quantity: phase_sine}
  - {quantity: phase_cosine}
)") + kJoints);
  const std::vector<float> expected = {0.025F, 0.05F, 0.075F, 0.01F, -0.02F, -0.99F, 1.0F,
                                       0.2F,   -0.1F, 0.1F,   0.1F,  0.25F,  1.0F,   0.0F};
  EXPECT_THAT(build(manifest, input_of_t1(), 0.25),
              testing::Pointwise(testing::FloatNear(1e-6F), expected));
}

TEST(ObservationBuilder, BuildsTheLayoutOfBoosterGymWhosePhaseIsZeroAtRest) {
  const PolicyManifest manifest = parse_manifest(std::string(R"(kind: walk
network: a.onnx
rate: 50
phase: {frequency: 1.5, at_rest: zeros}
observations:
  - {quantity: projected_gravity}
  - {quantity: angular_velocity}
  - {quantity: velocity_command}
  - {quantity: phase_cosine}
  - {quantity: phase_sine}
  - {quantity: joint_position}
  - {quantity: joint_velocity, scale: 0.1}
  - {quantity: last_action}
)") + kJoints);
  PolicyInput input = input_of_t1();
  const std::vector<float> moving = {0.01F, -0.02F, -0.99F, 0.1F, 0.2F, 0.3F, 0.5F,
                                     0.1F,  -0.4F,  -1.0F,  0.0F, 0.1F, 0.2F, 0.25F};
  EXPECT_THAT(build(manifest, input, 0.5), testing::Pointwise(testing::FloatNear(1e-6F), moving));
  input.command.setZero();
  std::vector<float> resting = moving;
  for (const size_t i : {6, 7, 8, 9, 10}) resting[i] = 0;
  EXPECT_THAT(build(manifest, input, 0.5), testing::Pointwise(testing::FloatNear(1e-6F), resting));
}

TEST(ObservationBuilder, BeginsItsPhaseAnewWithALead) {
  const PolicyManifest manifest = parse_manifest(std::string(R"(kind: walk
network: a.onnx
rate: 50
phase: {frequency: 1.25, start: 0.75}
observations: [{quantity: phase_sine}]
)") + kJoints);
  const std::vector<float> action(1);
  ObservationBuilder builder(manifest);
  builder.reset(0.5);
  EXPECT_NEAR(builder.build(input_of_t1(), action)[0], 1, 1e-6);
  builder.restart_phase(0);
  // A step of 0.025 cycles later.
  EXPECT_NEAR(builder.build(input_of_t1(), action)[0], std::sin(2 * M_PI * 0.775), 1e-6);
  EXPECT_NEAR(builder.phase(), 0.775, 1e-9);
}

TEST(ObservationBuilder, BuildsThePhasesOfBothFeetOfMujocoPlaygroundAndHolosoma) {
  const PolicyManifest manifest = parse_manifest(std::string(R"(kind: walk
network: a.onnx
rate: 50
phase: {frequency: 1, at_rest: half_cycle}
observations:
  - {quantity: phase_cosine, feet: [0, 0.5]}
  - {quantity: phase_sine, feet: [0, 0.5]}
  - {quantity: linear_command}
  - {quantity: turn_command}
  - {quantity: constant, values: [7, 8]}
)") + kJoints);
  PolicyInput input = input_of_t1();
  EXPECT_THAT(build(manifest, input, 0.25),
              testing::Pointwise(testing::FloatNear(1e-6F),
                                 std::vector<float>{0, 0, 1, -1, 0.5F, 0.1F, -0.4F, 7, 8}));
  input.command.setZero();
  EXPECT_THAT(build(manifest, input, 0.25),
              testing::Pointwise(testing::FloatNear(1e-6F),
                                 std::vector<float>{-1, -1, 0, 0, 0, 0, 0, 7, 8}));
}

/** Three steps with the turns 1, 2, 3 and two constants. */
std::vector<float> stack(const std::string& history) {
  const PolicyManifest manifest =
      parse_manifest("kind: walk\nnetwork: a.onnx\nrate: 50\nhistory: " + history + R"(
observations:
  - {quantity: turn_command}
  - {quantity: constant, values: [9]}
)" + kJoints);
  ObservationBuilder builder(manifest);
  std::vector<float> last;
  for (const double turn : {1.0, 2.0, 3.0}) {
    PolicyInput input = input_of_t1();
    input.command.z() = turn;
    last = builder.build(input, {0});
  }
  return last;
}

TEST(ObservationBuilder, StacksStepsAsTheManifestSays) {
  using testing::ElementsAre;
  EXPECT_THAT(stack("{steps: 2}"), ElementsAre(2, 3, 9, 9));
  EXPECT_THAT(stack("{steps: 2, order: newest_first}"), ElementsAre(3, 2, 9, 9));
  EXPECT_THAT(stack("{steps: 2, layout: by_step}"), ElementsAre(2, 9, 3, 9));
  EXPECT_THAT(stack("{steps: 2, layout: by_step, order: newest_first}"), ElementsAre(3, 9, 2, 9));
  EXPECT_THAT(stack("{steps: 4}"), ElementsAre(0, 1, 2, 3, 0, 9, 9, 9));
  EXPECT_THAT(stack("{steps: 4, start: first}"), ElementsAre(1, 1, 2, 3, 9, 9, 9, 9));
}

TEST(ObservationBuilder, ClipsATermBeforeItsScaleAndTheObservationAfterIt) {
  const PolicyManifest manifest = parse_manifest(std::string(R"(kind: walk
network: a.onnx
rate: 50
observation_clip: 3
observations:
  - {quantity: constant, values: [-10, 1, 10], scale: 2, clip: 1}
  - {quantity: constant, values: [10]}
)") + kJoints);
  EXPECT_THAT(build(manifest, input_of_t1()), testing::ElementsAre(-2, 2, 2, 3));
}

}  // namespace
}  // namespace nao
