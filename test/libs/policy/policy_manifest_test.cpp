#include "policy/policy_manifest.h"

#include <gmock/gmock.h>

#include <cmath>
#include <random>

#include "common/error.h"
#include "test/libs/policy/manifests.h"

namespace nao {
namespace {

std::string error_of(const std::string& text) {
  try {
    parse_manifest(text);
  } catch (const ModelError& error) {
    return error.what();
  }
  return "";
}

TEST(PolicyManifest, ReadsWhatItSays) {
  const PolicyManifest manifest = parse_manifest(kSmallManifest);
  EXPECT_EQ(manifest.kind, PolicyManifest::Kind::kWalk);
  EXPECT_EQ(manifest.num_observations(), 8);
  EXPECT_EQ(manifest.num_actions(), 2);
  EXPECT_DOUBLE_EQ(manifest.period, 0.02);
  const int knee = t1_model().find_motor("Left_Knee_Pitch");
  EXPECT_EQ(manifest.joints[0].motor, knee);
  EXPECT_EQ(manifest.joints[0].scale, 0.5);
  EXPECT_EQ(manifest.joints[1].scale, 0.25);
  EXPECT_EQ(manifest.kp[static_cast<size_t>(knee)], 200);
  EXPECT_TRUE(std::isnan(manifest.joints[1].damping));
  EXPECT_FALSE(manifest.fall_tilt);
  EXPECT_FALSE(manifest.recovery_margin);
  // Joints that the file does not name stand as the robot does.
  const int hip = t1_model().find_motor("Left_Hip_Pitch");
  EXPECT_EQ(manifest.default_position[static_cast<size_t>(hip)],
            t1_model().ready_posture().position[static_cast<size_t>(hip)]);
}

TEST(PolicyManifest, ReadsWhatItRecoversFrom) {
  const PolicyManifest manifest =
      parse_manifest(std::string(kSmallManifest) +
                     "phase: {frequency: 1.5}\nfall_tilt: 0.6\nrecovery_margin: 0.02\n");
  EXPECT_EQ(manifest.fall_tilt, 0.6);
  EXPECT_EQ(manifest.recovery_margin, 0.02);
}

TEST(PolicyManifest, NamesFileLineAndKeyOfWhatIsWrong) {
  const std::string good = kSmallManifest;
  struct {
    const char* part;
    const char* by;
    const char* complaint;
  } bad[] = {
      {"kind: walk", "kind: swim", "policy.yaml:1: kind must be walk, get-up or action"},
      {"rate: 50", "rate: 0", "rate must lie between"},
      {"rate: 50", "rat: 50", "rat is unknown"},
      {"rate: 50\n", "", "lacks \"rate\""},
      {"rate: 50", "rate: 50\nfall_tilt: 0.9", "fall_tilt must lie between"},
      {"rate: 50", "rate: 50\nrecovery_margin: 0", "recovery_margin needs \"phase\""},
      {"policy.onnx", "../policy.onnx", "must be the name of a file"},
      {"Left_Knee_Pitch", "Left_Knee", "is not a joint with a motor of the robot t1"},
      {"Right_Knee_Pitch", "Left_Knee_Pitch", "is listed twice"},
      {"default: 0.4, stiffness", "default: 40, stiffness", "default must lie between"},
      {"stiffness: 200", "stiffness: -1", "stiffness must lie between"},
      {"[2, 2, 0.25]", "[2, 2]", "must be 3 numbers"},
      {"quantity: joint_position", "quantity: joint_positions", "must be angular_velocity, "},
      {"quantity: joint_position", "quantity: phase_sine", "needs \"phase\" with a frequency"},
      {"quantity: joint_position", "quantity: constant", "lacks \"values\""},
      {"vx: [-0.2, 0.8]", "vx: [0.2, 0.8]", "must include 0"},
      {"command:", "duration: 3\ncommand:", "must not have \"duration\""},
      {"kind: walk", "kind: get-up", "must not have \"command\""},
      {"command: {vx: [-0.2, 0.8], vy: [-0.1, 0.1], wz: [-0.4, 0.4]}\n", "", "lacks \"command\""},
      {"rate: 50", "rate: 50\nhistory: {steps: 1.5}", "steps must be an integer"},
      {"rate: 50", "rate: .nan", "must be finite"},
  };
  for (const auto& fault : bad) {
    EXPECT_THAT(
        error_of(replaced(good, fault.part, fault.by)),
        testing::AllOf(testing::StartsWith("policy.yaml"), testing::HasSubstr(fault.complaint)));
  }
  EXPECT_EQ(error_of(good), "");
}

// As the fuzzer does, a little in each test run.
TEST(PolicyManifest, RefusesMutatedTextsWithAnErrorOfItsOwn) {
  std::mt19937 random(1);
  int num_refused = 0;
  for (int i = 0; i < 3000; ++i) {
    std::string text = kSmallManifest;
    for (int k = 0; k < 3; ++k) {
      const size_t at = random() % text.size();
      if (random() % 2 == 0) {
        text.erase(at, 1 + random() % 5);
      } else {
        text.insert(at, 1, static_cast<char>(random() % 256));
      }
    }
    num_refused += error_of(text).empty() ? 0 : 1;
  }
  EXPECT_GT(num_refused, 1000);
}

}  // namespace
}  // namespace nao
