#include "tools/transition-tuner/transition_text.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "common/error.h"
#include "daemons/motion/transitions/transition_graph.h"

namespace nao {
namespace {

const RobotModel& nao_model() {
  static const RobotModel model =
      RobotModel::load(std::filesystem::path(NAO_TEST_DATA) / "robots" / "nao");
  return model;
}

const std::string kText =
    "transitions:\n"
    "  # About rising.\n"
    "  - name: rise\n"
    "    from: belly\n"
    "    to: on-feet\n"
    "    keyframes:\n"
    "      - duration: 0.3  # s\n"
    "        joints: {HeadYaw: 0, KneePitch: 2.1, LHipRoll: -0.2}\n"
    "        stiffness: {KneePitch: 0.3}\n"
    "        pause: 0.1\n"
    "        ankle_damping: 0.1\n"
    "      - duration: 0.2\n"
    "        posture: Crouch\n"
    "        stiffness: {all: 1}\n"
    "  - name: fall\n"
    "    from: on-feet\n"
    "    to: belly\n"
    "    keyframes:\n"
    "      - duration: 0.7\n"
    "        joints: {KneePitch: 1.0}\n";

TEST(TransitionText, FindsTheNumbersOfTheSelectedSequences) {
  const TransitionText text(nao_model(), kText, {"rise"}, {"HeadYaw"});
  std::vector<std::string> names;
  for (const auto& parameter : text.parameters()) names.push_back(parameter.name);
  EXPECT_EQ(names,
            (std::vector<std::string>{"rise 0 duration", "rise 0 KneePitch", "rise 0 LHipRoll",
                                      "rise 0 stiffness KneePitch", "rise 0 pause",
                                      "rise 0 ankle_damping", "rise 1 duration"}));
  EXPECT_EQ(text.parameters()[1].value, 2.1);
}

// Pairs are named by robot.yaml's mirrored_joints, whatever the names of the joints have in common.
TEST(TransitionText, KnowsThePairsOfAnyRobot) {
  const RobotModel model = RobotModel::load(std::filesystem::path(NAO_TEST_DATA) / "robots" / "t1");
  const TransitionText text(model,
                            "transitions:\n"
                            "  - name: rise\n"
                            "    keyframes:\n"
                            "      - duration: 0.3\n"
                            "        joints: {Knee_Pitch: 2, Waist: 0.1}\n",
                            {"rise"}, {});
  ASSERT_EQ(text.parameters().size(), 3u);
  EXPECT_EQ(text.parameters()[1].name, "rise 0 Knee_Pitch");
  EXPECT_EQ(text.parameters()[1].upper,
            model.motor_joint(model.find_motor("Left_Knee_Pitch")).upper);
}

TEST(TransitionText, ChangesNumbersAndNothingElseWithinTheirRanges) {
  const TransitionText text(nao_model(), kText, {"rise"}, {"HeadYaw"});
  Eigen::VectorXd values(7);
  values << 0.25, 9, -0.1234, 0.05, 0, 0.5, 0.4;
  const std::string changed = text.with(values);
  EXPECT_NE(changed.find("duration: 0.250  # s\n"), std::string::npos) << changed;
  EXPECT_NE(changed.find("{HeadYaw: 0, KneePitch: 2.112, LHipRoll: -0.123}"), std::string::npos);
  EXPECT_NE(changed.find("stiffness: {KneePitch: 0.100}"), std::string::npos);
  EXPECT_NE(changed.find("ankle_damping: 0.300\n"), std::string::npos);
  EXPECT_NE(changed.find("joints: {KneePitch: 1.0}\n"), std::string::npos);
  // The new text loads: rounding moves no angle beyond its joint's limit.
  EXPECT_NO_THROW(motion::TransitionGraph::parse(nao_model(), changed));
}

TEST(TransitionText, NamesTheMissingSequenceOrJoint) {
  EXPECT_THROW(TransitionText(nao_model(), kText, {"fly"}, {}), Error);
  std::string tail = kText;
  tail.replace(tail.find("LHipRoll"), 8, "Tail");
  EXPECT_THROW(TransitionText(nao_model(), tail, {"rise"}, {}), Error);
}

}  // namespace
}  // namespace nao
