#include "daemons/motion/actions/taught_script.h"

#include <gtest/gtest.h>

#include <cmath>

#include "test/daemons/motion/nao_model.h"

namespace nao::motion {
namespace {

NamedMotion nod() {
  NamedMotion motion;
  motion.name = "nod";
  motion.joint_names = {"HeadPitch"};
  motion.keyframes = {{0.5, 0, {0.2}, {std::nan("")}}, {0.5, 0.1, {0}, {std::nan("")}}};
  return motion;
}

std::string fault_code(const NamedMotion& motion) {
  const auto script = to_script(nao_model(), motion);
  const auto* fault = std::get_if<MotionFault>(&script);
  return fault == nullptr ? "" : fault->reason.code;
}

TEST(TaughtScript, HasTheJointsOfTheMessageInMotorOrder) {
  const auto script = std::get<ActionScript>(to_script(nao_model(), nod()));
  EXPECT_EQ(script.start, "StandInit");
  EXPECT_EQ(script.end, ActionScript::End::kHolds);
  EXPECT_EQ(script.sequence.keyframes[0].position[nao_motor("HeadPitch")], 0.2);
  EXPECT_TRUE(std::isnan(script.sequence.keyframes[0].position[nao_motor("HeadYaw")]));
  const NamedMotion again = to_named(nao_model(), script);
  EXPECT_EQ(again.joint_names, nod().joint_names);
  EXPECT_EQ(again.keyframes[1].position, nod().keyframes[1].position);
}

TEST(TaughtScript, RefusesWhatIsNoMotion) {
  EXPECT_EQ(fault_code(nod()), "");
  NamedMotion wrong = nod();
  wrong.keyframes.clear();
  EXPECT_EQ(fault_code(wrong), "motion-keyframe-count");
  wrong = nod();
  wrong.keyframes.resize(201, wrong.keyframes[0]);
  EXPECT_EQ(fault_code(wrong), "motion-keyframe-count");
  wrong = nod();
  wrong.keyframes[1].duration = 0.05;
  EXPECT_EQ(fault_code(wrong), "motion-value-out-of-range");
  wrong.keyframes[1].duration = std::nan("");
  EXPECT_EQ(fault_code(wrong), "motion-value-out-of-range");
  wrong = nod();
  wrong.num_repetitions = 101;
  EXPECT_EQ(fault_code(wrong), "motion-value-out-of-range");
  wrong = nod();
  wrong.keyframes.resize(3, {50, 0, {0.1}, {1}});
  wrong.keyframes.resize(6, wrong.keyframes[2]);
  EXPECT_EQ(fault_code(wrong), "motion-too-long");
  wrong = nod();
  wrong.joint_names = {"Tail"};
  EXPECT_EQ(fault_code(wrong), "joint-unknown");
  wrong = nod();
  wrong.keyframes[0].position[0] = INFINITY;
  EXPECT_EQ(fault_code(wrong), "joint-value-not-finite");
  wrong = nod();
  wrong.start = "Headstand";
  EXPECT_EQ(fault_code(wrong), "posture-unknown");
}

TEST(TaughtScript, NamesTheKeyframeOfAFault) {
  NamedMotion wrong = nod();
  wrong.keyframes[1].pause = -1;
  const auto script = to_script(nao_model(), wrong);
  EXPECT_EQ(std::get<MotionFault>(script).keyframe, 1);
}

TEST(TaughtScript, StartsFromThePostureWhoseLegsAreNearest) {
  for (const char* name : {"StandZero", "StandInit", "Crouch", "Sit"}) {
    Keyframe keyframe;
    keyframe.position = nao_posture(name);
    keyframe.position[nao_motor("LKneePitch")] += 0.02;
    EXPECT_EQ(find_start_posture(nao_model(), {keyframe}), name);
    ActionScript script;
    script.start = name;
    EXPECT_EQ(starts_on_feet(nao_model(), script), std::string(name) != "Sit");
  }
}

}  // namespace
}  // namespace nao::motion
