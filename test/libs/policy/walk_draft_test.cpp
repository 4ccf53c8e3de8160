#include "policy/walk_draft.h"

#include <gtest/gtest.h>

#include "test/libs/policy/manifests.h"

namespace nao {
namespace {

RobotModel model_of(const std::string& name) {
  return RobotModel::load(std::filesystem::path(NAO_TEST_DATA) / "robots" / name);
}

PolicyManifest draft_of(const RobotModel& model) {
  return PolicyManifest::parse(model, draft_walk_policy(model), "policy.yaml");
}

TEST(WalkDraft, MovesTheLegsOfEachRobotAboutItsReadyPosture) {
  for (const char* name : {"t1", "k1", "g1"}) {
    const RobotModel model = model_of(name);
    const PolicyManifest manifest = draft_of(model);
    EXPECT_EQ(manifest.num_actions(), 12) << name;
    EXPECT_EQ(manifest.num_observations(), 47) << name;
    for (const PolicyJoint& joint : manifest.joints) {
      const auto motor = static_cast<size_t>(joint.motor);
      EXPECT_NEAR(joint.default_angle, model.ready_posture().position[motor], 1e-3) << name;
    }
  }
}

TEST(WalkDraft, NamesAMotorOfBothLegsOnce) {
  const RobotModel nao = model_of("nao");
  EXPECT_EQ(draft_of(nao).num_actions(), 11);
}

TEST(WalkDraft, StepsFasterAndWalksSlowerTheSmallerTheRobotIs) {
  const PolicyManifest t1 = draft_of(model_of("t1"));
  const PolicyManifest nao = draft_of(model_of("nao"));
  EXPECT_NEAR(t1.phase_frequency, 1.5, 0.05);
  EXPECT_GT(nao.phase_frequency, 1.3 * t1.phase_frequency);
  EXPECT_LT(nao.vx.upper, 0.75 * t1.vx.upper);
}

}  // namespace
}  // namespace nao
