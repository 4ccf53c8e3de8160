#include "daemons/motion-files/motion_checker.h"

#include <gtest/gtest.h>

#include "daemons/motion-files/rollout.h"
#include "test/daemons/motion-files/motions.h"
#include "test/daemons/motion/nao_model.h"

namespace nao {
namespace {

using motion::ActionScript;
using motion::MotionFault;

class MotionCheckerTest : public testing::Test {
 protected:
  MotionFault static_fault(const std::string& keyframes, const std::string& more = "") {
    const auto fault = checker_.find_static_fault(make_motion(keyframes, more));
    EXPECT_TRUE(fault);
    return fault.value_or(MotionFault{});
  }

  MotionChecker checker_{test_options()};
};

TEST_F(MotionCheckerTest, AcceptsAWave) {
  const MotionReport report = checker_.check(make_motion(kWave, "repetitions: 2, "));
  EXPECT_FALSE(report.fault) << report.fault->reason;
  EXPECT_FALSE(report.repaired);
}

TEST_F(MotionCheckerTest, NamesJointAndKeyframeBeyondALimit) {
  const MotionFault fault =
      static_fault("{duration: 1, joints: {HeadYaw: 0.5}}, {duration: 1, joints: {HeadYaw: 2.2}}");
  EXPECT_EQ(fault.keyframe, 1);
  EXPECT_EQ(fault.reason.code, "motion-beyond-limit");
  EXPECT_EQ(fault.reason.arguments.at(0), "HeadYaw");
}

TEST_F(MotionCheckerTest, KnowsLimitsThatDependOnAnotherJoint) {
  const MotionFault fault = static_fault("{duration: 1, joints: {HeadYaw: 1.5, HeadPitch: 0.5}}");
  EXPECT_EQ(fault.reason.code, "motion-beyond-limit");
  EXPECT_EQ(fault.reason.arguments.at(0), "HeadPitch");
}

TEST_F(MotionCheckerTest, ClipsWhatAMeasuredPoseExceedsAndOffersToClipMore) {
  const int yaw = test_model()->find_motor("HeadYaw");
  MotionReport report = checker_.check(make_motion("{duration: 1, joints: {HeadYaw: 2.095}}"));
  EXPECT_FALSE(report.fault);
  EXPECT_LE(report.script.sequence.keyframes[0].position[yaw],
            test_model()->motor_joint(yaw).upper);
  report = checker_.check(make_motion("{duration: 1, joints: {HeadYaw: 2.5}}"));
  ASSERT_TRUE(report.fault && report.repaired);
  EXPECT_EQ(report.repair, "clipped");
  EXPECT_FALSE(checker_.check(*report.repaired).fault);
}

TEST_F(MotionCheckerTest, OffersToSlowDownWhatIsTooFast) {
  const MotionReport report = checker_.check(
      make_motion("{duration: 0.1, joints: {RShoulderPitch: -1}}, {duration: 0.1, joints: "
                  "{RShoulderPitch: 1.4}}"));
  ASSERT_TRUE(report.fault && report.repaired);
  EXPECT_EQ(report.fault->reason.code, "motion-too-fast");
  EXPECT_EQ(report.fault->keyframe, 0);
  EXPECT_EQ(report.repair, "slowed-down");
  EXPECT_FALSE(checker_.check(*report.repaired).fault);
}

TEST_F(MotionCheckerTest, SeesThatARepetitionStartsFromTheLastKeyframe) {
  const std::string keyframes =
      "{duration: 0.2, joints: {HeadYaw: 0.1}}, {duration: 1, joints: {HeadYaw: 2}}";
  EXPECT_FALSE(checker_.find_static_fault(make_motion(keyframes)));
  EXPECT_EQ(static_fault(keyframes, "repetitions: 2, ").keyframe, 0);
}

TEST_F(MotionCheckerTest, RefusesAnArmInTheBody) {
  const MotionFault fault = static_fault(
      "{duration: 1, joints: {HeadYaw: 0.3}}, {duration: 2, joints: {LShoulderPitch: 1.0, "
      "LShoulderRoll: -0.3, LElbowYaw: -1.5, LElbowRoll: -1.5}}");
  EXPECT_EQ(fault.reason.code, "motion-self-contact");
  EXPECT_EQ(fault.keyframe, 1);
}

TEST_F(MotionCheckerTest, RefusesAFallWithItsKeyframe) {
  const MotionReport report = checker_.check(make_motion(
      "{duration: 1, joints: {HeadYaw: 0.5}}, {duration: 1, joints: {LHipPitch: -1.2, RHipPitch: "
      "-1.2}}"));
  ASSERT_TRUE(report.fault);
  EXPECT_EQ(report.fault->reason.code, "motion-fall");
  EXPECT_EQ(report.fault->keyframe, 1);
  EXPECT_FALSE(report.repaired);
}

TEST_F(MotionCheckerTest, AcceptsLinksThatPassAtTwoMillimeters) {
  const RobotModel& model = *test_options().model;
  std::vector<double> position = model.ready_posture().position;
  position[motion::nao_motor("LShoulderRoll")] = -0.305;
  const double clearance = motion::SelfCollisionGuard(model).calc_clearance(position);
  ASSERT_LT(clearance, motion::SelfCollisionGuard::kClearance);
  ASSERT_GT(clearance, 0.001);
  EXPECT_FALSE(
      checker_.find_static_fault(make_motion("{duration: 1, joints: {LShoulderRoll: -0.305}}")));
}

TEST_F(MotionCheckerTest, SimulatesFromASeatToo) {
  const MotionReport report = checker_.check(
      make_motion("{duration: 1, joints: {LShoulderPitch: 0.3, HeadYaw: 0.5}}", "start: Sit, "));
  EXPECT_FALSE(report.fault) << report.fault->reason;
}

TEST(Rollout, TellsAJointThatTheFloorBlocks) {
  // The robot leans back on its hands; the right one pushes inward, which friction prevents.
  const auto fault = roll_out(
      test_options(), 5,
      make_motion("{duration: 0.6, pause: 1, joints: {RShoulderPitch: 1.76, RShoulderRoll: 0.22}}",
                  "start: SitRelax, "));
  ASSERT_TRUE(fault);
  EXPECT_EQ(fault->reason.code, "motion-joint-blocked");
  EXPECT_EQ(fault->keyframe, 0);
}

TEST(Rollout, StopEndsAMotionWithoutAFall) {
  const ActionScript squat = make_motion(
      "{duration: 1, posture: Crouch}, {duration: 1, posture: StandInit}", "repetitions: 50, ");
  for (const double stop_time : {0.6, 1.3, 2.2}) {
    RolloutEnd end;
    end.stop_time = stop_time;
    const auto fault = roll_out(test_options(), 5, squat, end);
    EXPECT_FALSE(fault) << fault->reason;
  }
}

}  // namespace
}  // namespace nao
