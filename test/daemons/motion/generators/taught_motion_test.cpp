#include "daemons/motion/generators/taught_motion.h"

#include <gmock/gmock.h>

#include <cmath>

#include "daemons/motion/actions/taught_script.h"
#include "test/daemons/motion/fake_motion.h"
#include "test/daemons/motion/perfect_robot.h"
#include "test/daemons/motion/robot_at_rest.h"

namespace nao::motion {
namespace {

ActionScript arm_motion(int repetitions) {
  NamedMotion motion;
  motion.name = "arms";
  motion.num_repetitions = repetitions;
  motion.joint_names = {"LShoulderPitch"};
  motion.keyframes = {{0.6, 0, {0.8}, {std::nan("")}}, {0.6, 0.2, {1.4}, {std::nan("")}}};
  return std::get<ActionScript>(to_script(nao_model(), motion));
}

/** The motion as an action of a core with a perfect robot. */
class TaughtMotionTest : public ::testing::Test {
 protected:
  void teach(const ActionScript& script) {
    robot_.settle(core_);
    robot_.step(core_, {}, {{script.sequence.name, std::make_shared<const ActionScript>(script)}});
  }
  Output send(decltype(Command::request) request) {
    return robot_.step(core_, {{"test", ++last_id_, std::move(request)}});
  }
  Output play(const std::string& name) {
    const double nan = std::nan("");
    return send(ActionCommand{name, nan, nan, nan});
  }
  double shoulder() { return robot_.sensors().position[nao_motor("LShoulderPitch")]; }

  MotionCore core_{nao_model(), MotionOptions()};
  PerfectRobot robot_;
  int64_t last_id_ = 0;
};

TEST_F(TaughtMotionTest, IsUnknownUntilItIsTaughtAndAfterItIsDeleted) {
  EXPECT_EQ(play("arms").results.at(0).reason.code, "action-unknown");
  teach(arm_motion(1));
  EXPECT_EQ(play("arms").results.at(0).status, ResultStatus::kAccepted);
  robot_.settle(core_);
  robot_.step(core_, {}, {{"arms", nullptr}});
  EXPECT_EQ(play("arms").results.at(0).reason.code, "action-unknown");
}

TEST_F(TaughtMotionTest, PlaysItsKeyframesAsOftenAsItSays) {
  teach(arm_motion(3));
  play("arms");
  int num_lows = 0;
  bool is_low = false;
  std::vector<CommandResult> results;
  for (int i = 0; i < 1000; ++i) {
    const Output output = robot_.step(core_);
    results.insert(results.end(), output.results.begin(), output.results.end());
    if (!is_low && shoulder() < 0.81) ++num_lows;
    is_low = shoulder() < (is_low ? 0.9 : 0.81);
  }
  EXPECT_EQ(num_lows, 3);
  EXPECT_NEAR(shoulder(), 1.4, 1e-6);
  ASSERT_EQ(results.size(), 1u);
  EXPECT_EQ(results[0].status, ResultStatus::kDone);
}

TEST_F(TaughtMotionTest, GoesToItsStartPostureFirst) {
  ActionScript script = arm_motion(1);
  script.start = "Crouch";
  teach(script);
  play("arms");
  int keyframe = -1;
  for (int i = 0; i < 2000 && keyframe < 0; ++i) {
    robot_.step(core_);
    keyframe = core_.motion_state().keyframe;
  }
  EXPECT_EQ(keyframe, 0);
  EXPECT_NEAR(robot_.sensors().position[nao_motor("LKneePitch")],
              nao_posture("Crouch")[nao_motor("LKneePitch")], 0.02);
}

TEST_F(TaughtMotionTest, SlowsDownWhenItIsStopped) {
  teach(arm_motion(100));
  play("arms");
  for (int i = 0; i < 100; ++i) robot_.step(core_);
  send(StopCommand{});
  double fastest = 0;
  int num_steps = 0;
  double last = shoulder();
  while (core_.motion_state().mode != Mode::kHolding && num_steps < 200) {
    robot_.step(core_);
    fastest = std::max(fastest, std::abs(shoulder() - last) / 0.01);
    last = shoulder();
    ++num_steps;
  }
  EXPECT_LT(num_steps, 60);
  EXPECT_LT(fastest, 2);
}

TEST(TaughtMotion, PlaysOnWhereTheRobotWouldNotStand) {
  // Bent forward, its center of mass is ahead of the feet.
  NamedMotion bend;
  bend.name = "bend";
  bend.joint_names = {"LHipPitch", "RHipPitch"};
  const double nan = std::nan("");
  bend.keyframes = {{1, 0.5, {-1.2, -1.2}, {nan, nan}}, {1, 2, {-0.45, -0.45}, {nan, nan}}};
  const auto script =
      std::make_shared<const ActionScript>(std::get<ActionScript>(to_script(nao_model(), bend)));
  RobotAtRest robot;
  FakeMotion::Script approach;
  approach.phase = MotionGenerator::Phase::kDone;
  TaughtMotion motion(nao_model(), script, std::make_unique<FakeMotion>(approach), true);
  JointTargets targets = robot.targets();
  motion.start(robot.context(), targets);
  double time = 0;
  const auto run_to = [&](double end) {
    MotionGenerator::Phase phase = MotionGenerator::Phase::kRunning;
    for (; time < end && phase == MotionGenerator::Phase::kRunning; time += 0.01) {
      phase = motion.step(robot.context(0.01), targets);
    }
    return phase;
  };
  run_to(0.9);
  motion.finish();
  EXPECT_FALSE(motion.can_be_replaced());
  EXPECT_EQ(run_to(1.6), MotionGenerator::Phase::kRunning);
  EXPECT_LT(targets.position[nao_motor("LHipPitch")], -1);
  EXPECT_EQ(run_to(3.5), MotionGenerator::Phase::kDone);
  EXPECT_NEAR(targets.position[nao_motor("LHipPitch")], -0.45, 0.15);
}

class LimpJointTest : public TaughtMotionTest {
 protected:
  JointChangeCommand stiffen(const std::string& joint, double stiffness) {
    JointChangeCommand change{{joint}, {0}, true, 0.5, false};
    change.joint_stiffness = {stiffness};
    return change;
  }
};

TEST_F(LimpJointTest, FollowsTheHandThatMovesIt) {
  robot_.settle(core_);
  EXPECT_EQ(send(stiffen("LShoulderRoll", 0)).results.at(0).status, ResultStatus::kAccepted);
  for (int i = 0; i < 100; ++i) robot_.step(core_);
  EXPECT_EQ(robot_.sensors().stiffness[nao_motor("LShoulderRoll")], 0);
  EXPECT_EQ(robot_.sensors().stiffness[nao_motor("LShoulderPitch")], 1);
  for (int i = 0; i < 50; ++i) {
    robot_.sensors().position[nao_motor("LShoulderRoll")] += 0.01;
    robot_.step(core_);
  }
  const double there = robot_.sensors().position[nao_motor("LShoulderRoll")];
  EXPECT_NEAR(there, 0.3 + 0.5, 0.02);
  send(stiffen("LShoulderRoll", 1));
  for (int i = 0; i < 100; ++i) robot_.step(core_);
  EXPECT_EQ(robot_.sensors().stiffness[nao_motor("LShoulderRoll")], 1);
  EXPECT_NEAR(robot_.sensors().position[nao_motor("LShoulderRoll")], there, 0.02);
}

TEST_F(LimpJointTest, ANewerChangeDoesNotEndTheRampOfOtherJoints) {
  robot_.settle(core_);
  const std::vector<const char*> joints = {"LShoulderPitch", "LShoulderRoll", "RShoulderPitch",
                                           "RShoulderRoll"};
  // As a phone sends them: the first two within one control step, the others in the next ones.
  int64_t id = 100;
  robot_.step(core_,
              {{"hand", ++id, stiffen(joints[0], 0)}, {"hand", ++id, stiffen(joints[1], 0)}});
  const int first = nao_motor(joints[0]);
  for (int i = 0; i < 25; ++i) robot_.step(core_);
  EXPECT_NEAR(robot_.sensors().stiffness[first], 0.48, 0.03);
  const double before = robot_.sensors().stiffness[first];
  robot_.step(core_, {{"hand", ++id, stiffen(joints[2], 0)}});
  // Neither a jump nor a new ramp of 0.5 s.
  EXPECT_NEAR(robot_.sensors().stiffness[first], before - 0.02, 1e-9);
  robot_.step(core_, {{"hand", ++id, stiffen(joints[3], 0)}});
  for (int i = 0; i < 24; ++i) robot_.step(core_);
  EXPECT_EQ(robot_.sensors().stiffness[first], 0);
  for (int i = 0; i < 30; ++i) robot_.step(core_);
  for (const char* joint : joints) {
    EXPECT_EQ(robot_.sensors().stiffness[nao_motor(joint)], 0) << joint;
  }
  // A joint that the newer change names follows the newer one.
  robot_.step(core_, {{"hand", ++id, stiffen(joints[0], 1)}});
  for (int i = 0; i < 10; ++i) robot_.step(core_);
  robot_.step(core_, {{"hand", ++id, stiffen(joints[0], 0.5)}});
  for (int i = 0; i < 60; ++i) robot_.step(core_);
  EXPECT_EQ(robot_.sensors().stiffness[first], 0.5);
}

TEST_F(LimpJointTest, IsRefusedWhereItCarriesTheRobot) {
  robot_.settle(core_);
  const CommandResult refused = send(stiffen("LKneePitch", 0.2)).results.at(0);
  EXPECT_EQ(refused.status, ResultStatus::kRefused);
  EXPECT_EQ(refused.reason, Reason("joint-carries-robot", {"LKneePitch"}));
  EXPECT_EQ(send(stiffen("LKneePitch", 0.9)).results.at(0).status, ResultStatus::kAccepted);
}

}  // namespace
}  // namespace nao::motion
