#include "daemons/motion/motion_core.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <random>

#include "test/daemons/motion/perfect_robot.h"

namespace nao::motion {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

Command posture(int64_t id, const std::string& name, double speed = 0.5) {
  return {"test", id, PostureCommand{name, speed}};
}

Command joint_change(int64_t id, std::vector<std::string> names, std::vector<double> angles,
                     bool is_relative = false, double speed = 1) {
  return {"test", id,
          JointChangeCommand{std::move(names), std::move(angles), is_relative, speed, false}};
}

bool is_final(ResultStatus status) {
  return status != ResultStatus::kAccepted;
}

class MotionCoreTest : public ::testing::Test {
 protected:
  CommandResult refused(const Command& command) {
    const Output output = robot_.step(core_, {command});
    EXPECT_EQ(output.results.size(), 1u);
    EXPECT_EQ(output.results.at(0).status, ResultStatus::kRefused);
    return output.results.at(0);
  }

  MotionCore core_{nao_model(), MotionOptions()};
  PerfectRobot robot_;
};

TEST_F(MotionCoreTest, TakesOverWithoutAJumpAndGoesToStandInit) {
  auto& position = robot_.sensors().position;
  position = nao_model().find_posture("StandZero")->position;
  position[nao_model().find_motor("LShoulderPitch")] = 0.4;
  robot_.sensors().target_position = position;
  std::vector<double> last = position;
  for (int i = 0; i < 1000; ++i) {
    const Output output = robot_.step(core_);
    for (int motor = 0; motor < nao_model().num_motors(); ++motor) {
      const double step = std::abs(output.joint_targets->position[motor] - last[motor]);
      EXPECT_LE(step, nao_model().motor_joint(motor).max_velocity * 0.01 * (1 + 1e-9));
    }
    last = output.joint_targets->position;
  }
  EXPECT_EQ(core_.motion_state().mode, Mode::kHolding);
  EXPECT_EQ(core_.motion_state().posture, "StandInit");
  EXPECT_EQ(last, nao_model().find_posture("StandInit")->position);
}

TEST_F(MotionCoreTest, ContinuesFromWhatTheServosHoldHoweverFarTheJointsAre) {
  // An arm caught below the body, at a third of the stiffness, as after a fall.
  const int elbow = nao_model().find_motor("LElbowRoll");
  robot_.sensors().target_position[elbow] = -1.5;
  robot_.sensors().position[elbow] = -0.2;
  robot_.sensors().stiffness.assign(nao_model().num_motors(), 0.3);
  const Output output = robot_.step(core_);
  EXPECT_EQ(output.joint_targets->position, robot_.sensors().target_position);
  EXPECT_EQ(output.joint_targets->stiffness.at(elbow), 0.3);
  robot_.settle(core_);
  EXPECT_EQ(core_.motion_state().posture, "StandInit");
  EXPECT_EQ(core_.motion_state().stiffness, 1);
}

TEST_F(MotionCoreTest, ARelaxedRobotStaysRelaxedUntilACommandWakesItUp) {
  robot_ = PerfectRobot("Crouch");
  robot_.sensors().stiffness.assign(nao_model().num_motors(), 0.0);
  for (int i = 0; i < 100; ++i) robot_.step(core_);
  EXPECT_EQ(core_.motion_state().mode, Mode::kRelaxed);
  EXPECT_EQ(core_.motion_state().stiffness, 0);
  robot_.step(core_, {{"test", 1, ActionCommand{"wake-up", kNan, kNan, kNan}}});
  robot_.settle(core_);
  EXPECT_EQ(core_.motion_state().posture, "StandInit");
  EXPECT_EQ(core_.motion_state().stiffness, 1);
}

TEST_F(MotionCoreTest, KeepsAKnownPostureWhenItTakesOver) {
  robot_ = PerfectRobot("Crouch");
  robot_.settle(core_);
  EXPECT_EQ(core_.motion_state().posture, "Crouch");
}

TEST_F(MotionCoreTest, GoesToEachPostureOnItsFeet) {
  robot_.settle(core_);
  int64_t id = 0;
  for (const char* name : {"Crouch", "StandZero", "Stand", "Crouch", "StandInit"}) {
    const Output output = robot_.step(core_, {posture(++id, name)});
    ASSERT_EQ(output.results.size(), 1u);
    EXPECT_EQ(output.results[0].status, ResultStatus::kAccepted);
    EXPECT_EQ(core_.motion_state().mode, Mode::kMoving);
    EXPECT_EQ(core_.motion_state().command_kind, CommandKind::kPosture);
    EXPECT_EQ(core_.motion_state().command_name, name);
    const auto results = robot_.settle(core_);
    ASSERT_EQ(results.size(), 1u);
    EXPECT_EQ(results[0].status, ResultStatus::kDone);
    EXPECT_EQ(results[0].id, id);
    EXPECT_EQ(core_.motion_state().posture, name);
  }
}

TEST_F(MotionCoreTest, RefusesInvalidCommandsWithTheReason) {
  robot_.settle(core_);
  const std::vector<double> before = robot_.sensors().position;
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const Reason lotus = refused(posture(1, "Lotus")).reason;
  EXPECT_EQ(lotus.code, "posture-unknown");
  EXPECT_EQ(lotus.arguments.at(0), "\"Lotus\"");
  EXPECT_EQ(refused(posture(2, "Stand", 0)).reason, Reason("speed-out-of-range", {"0"}));
  EXPECT_EQ(refused(posture(3, "Stand", 1.01)).reason, Reason("speed-out-of-range", {"1.01"}));
  EXPECT_EQ(refused(posture(4, "Stand", kNan)).reason, Reason("speed-out-of-range", {"nan"}));
  EXPECT_EQ(refused(joint_change(5, {"Tail"}, {1})).reason, Reason("joint-unknown", {"\"Tail\""}));
  EXPECT_EQ(refused(joint_change(6, {"HeadYaw"}, {kNan})).reason,
            Reason("joint-value-not-finite", {"HeadYaw", "position"}));
  EXPECT_EQ(refused(joint_change(7, {"HeadYaw", "HeadPitch"}, {1})).reason,
            Reason("joint-lists-unequal", {"2", "position", "1"}));
  EXPECT_EQ(refused(joint_change(8, {}, {})).reason, Reason("joints-missing"));
  EXPECT_EQ(refused(joint_change(9, {"HeadYaw", "HeadYaw"}, {1, 1})).reason,
            Reason("joint-repeated", {"HeadYaw"}));
  EXPECT_EQ(refused(joint_change(10, {"RHipYawPitch"}, {0.1})).reason,
            Reason("joint-without-motor", {"RHipYawPitch"}));
  EXPECT_EQ(refused(joint_change(11, {"LSoleFixed"}, {0.1})).reason,
            Reason("joint-unknown", {"\"LSoleFixed\""}));
  EXPECT_EQ(refused({"test", 12, ActionCommand{"fly", kNan, kNan, kNan}}).reason.code,
            "action-unknown");
  EXPECT_EQ(refused({"test", 13, ActionCommand{"kick-left", kNan, kNan, 2}}).reason,
            Reason("strength-out-of-range", {"2"}));
  EXPECT_EQ(refused({"test", 14, WalkCommand{kNan, 0, 0}}).reason, Reason("velocity-not-finite"));
  EXPECT_EQ(refused({"test", 15, MoveToCommand{0, kInfinity, 0}}).reason,
            Reason("goal-not-finite"));
  EXPECT_EQ(refused({"test", 0, StopCommand{}}).reason, Reason("command-id-zero"));
  EXPECT_EQ(refused({"", 1, StopCommand{}}).reason, Reason("source-missing"));
  EXPECT_EQ(refused({std::string(70, 'x'), 1, StopCommand{}}).reason,
            Reason("source-too-long", {"70", "64"}));
  EXPECT_EQ(core_.motion_state().last_refusal, Reason("source-too-long", {"70", "64"}));
  EXPECT_EQ(robot_.sensors().position, before);
}

TEST_F(MotionCoreTest, AnswersARepeatedCommandAgainAndExecutesItOnce) {
  robot_.settle(core_);
  const Command nod = joint_change(1, {"HeadPitch"}, {0.2}, true);
  EXPECT_EQ(robot_.step(core_, {nod, nod}).results.size(), 2u);
  robot_.settle(core_);
  const Output output = robot_.step(core_, {nod});
  ASSERT_EQ(output.results.size(), 1u);
  EXPECT_EQ(output.results[0].status, ResultStatus::kDone);
  robot_.settle(core_);
  EXPECT_NEAR(robot_.sensors().position[nao_model().find_motor("HeadPitch")], 0.2, 1e-9);
}

TEST_F(MotionCoreTest, NewerCommandInterruptsTheOlder) {
  robot_.settle(core_);
  robot_.step(core_, {posture(1, "Crouch", 0.2)});
  for (int i = 0; i < 20; ++i) robot_.step(core_);
  const Output output = robot_.step(core_, {posture(2, "StandZero")});
  ASSERT_EQ(output.results.size(), 2u);
  EXPECT_EQ(output.results[0].status, ResultStatus::kAccepted);
  EXPECT_EQ(output.results[0].id, 2);
  EXPECT_EQ(output.results[1].status, ResultStatus::kInterrupted);
  EXPECT_EQ(output.results[1].id, 1);
  EXPECT_EQ(output.results[1].reason, Reason("replaced", {"StandZero"}));
  robot_.settle(core_);
  EXPECT_EQ(core_.motion_state().posture, "StandZero");
}

TEST_F(MotionCoreTest, StopHoldsWhereItIs) {
  robot_.settle(core_);
  robot_.step(core_, {posture(1, "Crouch", 0.3)});
  for (int i = 0; i < 200; ++i) robot_.step(core_);
  const Command stop = {"test", 2, StopCommand{}};
  robot_.step(core_, {stop});
  const auto results = robot_.settle(core_);
  ASSERT_EQ(results.size(), 1u);
  EXPECT_EQ(results[0].id, 2);
  EXPECT_EQ(results[0].status, ResultStatus::kDone);
  EXPECT_EQ(core_.motion_state().posture, "");
  const double knee = robot_.sensors().position[nao_model().find_motor("LKneePitch")];
  EXPECT_GT(knee, 0.71);
  EXPECT_LT(knee, 2.1);
}

TEST_F(MotionCoreTest, ClipsJointChangesToSingleAndCoupledLimits) {
  robot_.settle(core_);
  robot_.step(core_, {joint_change(1, {"HeadYaw", "HeadPitch"}, {1.526988, 5})});
  const auto results = robot_.settle(core_);
  ASSERT_EQ(results.size(), 1u);
  EXPECT_EQ(results[0].reason, Reason("clipped-to-limits", {"HeadPitch"}));
  EXPECT_NEAR(robot_.sensors().position[nao_model().find_motor("HeadPitch")], 0.200015, 1e-6);
}

TEST_F(MotionCoreTest, HeadAndArmsMoveInTheFirstTickAndLegsStartSmoothly) {
  // Target change with which a servo with the head's delay of 27 ms turns one encoder step in a
  // tick, rad.
  constexpr double kVisible = 0.007;
  constexpr double kSmooth = 0.001;
  int64_t id = 0;
  for (const auto& [name, change] : {std::pair{"HeadYaw", 0.4},
                                     {"LShoulderPitch", -0.4},
                                     {"RElbowYaw", 0.4},
                                     {"LKneePitch", 0.2}}) {
    robot_.settle(core_);
    const int motor = nao_model().find_motor(name);
    const double before = robot_.sensors().position[motor];
    robot_.step(core_, {{"test", ++id, JointChangeCommand{{name}, {change}, true, 1, true}}});
    const double moved = (robot_.sensors().position[motor] - before) * (change > 0 ? 1 : -1);
    if (std::string(name) == "LKneePitch") {
      EXPECT_LT(moved, kSmooth);
    } else {
      EXPECT_GT(moved, kVisible) << name;
    }
  }
}

TEST_F(MotionCoreTest, SilentSensorsMeanNoRobot) {
  robot_.settle(core_);
  robot_.step(core_, {posture(1, "Crouch", 0.2)});
  Input silent;
  std::vector<CommandResult> results;
  for (int i = 0; i < 12; ++i) {
    const Output output = core_.step(silent, 0.05);
    EXPECT_FALSE(output.joint_targets);
    results.insert(results.end(), output.results.begin(), output.results.end());
  }
  EXPECT_EQ(core_.motion_state().mode, Mode::kNoRobot);
  ASSERT_EQ(results.size(), 1u);
  EXPECT_EQ(results[0].status, ResultStatus::kFailed);
  EXPECT_EQ(results[0].reason, Reason("no-robot"));
  silent.commands = {posture(2, "Stand")};
  EXPECT_EQ(core_.step(silent, 0.05).results.at(0).status, ResultStatus::kRefused);
  // The robot is back with its joints elsewhere: the targets start at what the servos hold.
  const int head = nao_model().find_motor("HeadYaw");
  robot_.sensors().position[head] = 1.0;
  robot_.sensors().target_position[head] = 1.1;
  const Output output = robot_.step(core_);
  EXPECT_NEAR(output.joint_targets->position[head], 1.1, 1e-9);
  robot_.settle(core_);
  EXPECT_EQ(core_.motion_state().posture, "StandInit");
}

/** Result of a head turn and a crouch of a standing robot. */
struct Course {
  std::vector<double> targets;
  /** Duration of the crouch, s. */
  double duration = 0;
};

/** @param period  Control period, s. */
Course turn_head_and_crouch(double period) {
  MotionCore core(nao_model(), MotionOptions());
  PerfectRobot robot("StandInit", period);
  Course course;
  course.targets = robot.sensors().target_position;
  const auto step = [&](std::vector<Command> commands) {
    const Output output = robot.step(core, std::move(commands));
    for (int motor = 0; motor < nao_model().num_motors(); ++motor) {
      const double change = std::abs(output.joint_targets->position[motor] - course.targets[motor]);
      EXPECT_LE(change, nao_model().motor_joint(motor).max_velocity * period * (1 + 1e-9));
    }
    course.targets = output.joint_targets->position;
  };
  const auto execute = [&](const Command& command) {
    step({command});
    double duration = period;
    for (; duration < 10 && core.motion_state().mode != Mode::kHolding; duration += period)
      step({});
    return duration;
  };
  robot.settle(core);
  execute(joint_change(1, {"HeadYaw"}, {0.5}));
  course.duration = execute(posture(2, "Crouch", 0.5));
  EXPECT_EQ(core.motion_state().posture, "Crouch");
  return course;
}

TEST(MotionCore, RunsAtAnyControlPeriod) {
  const Course expected = turn_head_and_crouch(0.010);
  for (const double period : {0.008, 0.012, 0.020}) {
    const Course course = turn_head_and_crouch(period);
    EXPECT_EQ(course.targets, expected.targets) << period;
    EXPECT_NEAR(course.duration, expected.duration, 2 * period) << period;
  }
}

TEST(MotionCore, GetsUpAfterTheSameTimeAtAnyControlPeriod) {
  for (const double period : {0.010, 0.012}) {
    MotionOptions options;
    options.policy = kNoPolicy;
    MotionCore core(nao_model(), options);
    PerfectRobot robot("StandInit", period);
    robot.settle(core);
    robot.lie_on_belly();
    // When it begins to get up, and when its joints begin to move for that.
    double begin = 0;
    double time = 0;
    const std::vector<double> lying = robot.step(core).joint_targets->position;
    for (std::vector<double> targets = lying; time < 5 && targets == lying; time += period) {
      targets = robot.step(core).joint_targets->position;
      if (core.motion_state().mode != Mode::kGettingUp) begin = time;
    }
    EXPECT_NEAR(begin, options.get_up_delay, 4 * period) << period;
    // The delay before it gets up, and the time for which it must lie still.
    EXPECT_NEAR(time, options.get_up_delay + 0.1, 4 * period) << period;
  }
}

// The command may come before the robot gets up, or while it rests before that.
TEST(MotionCore, GetsUpAfterItsHeadWasTurnedOnTheGround) {
  const double delay = MotionOptions().get_up_delay;
  for (const double when : {0.5 * delay, delay + 0.05}) {
    MotionCore core(nao_model(), MotionOptions());
    PerfectRobot robot("StandInit", 0.010);
    robot.settle(core);
    robot.lie_on_belly();
    bool gets_up = false;
    for (int tick = 0; tick < 1000 && !gets_up; ++tick) {
      if (tick == static_cast<int>(when / 0.010)) {
        robot.step(core, {joint_change(1, {"HeadYaw"}, {0.3})});
      } else {
        robot.step(core);
      }
      gets_up = core.motion_state().mode == Mode::kGettingUp;
    }
    EXPECT_TRUE(gets_up) << when;
  }
}

TEST_F(MotionCoreTest, StatesComeAtEachChangeAndTenTimesASecond) {
  robot_.settle(core_);
  int num_states = 0;
  for (int i = 0; i < 100; ++i) num_states += robot_.step(core_).motion_state.has_value() ? 1 : 0;
  EXPECT_EQ(num_states, 10);
  EXPECT_TRUE(robot_.step(core_, {posture(1, "Crouch")}).motion_state.has_value());
}

TEST_F(MotionCoreTest, ThousandsOfRandomCommandsEachGetExactlyOneFinalResult) {
  std::mt19937 random(5);
  std::uniform_int_distribution<int> pick(0, 9);
  std::uniform_int_distribution<int> pick_motor(0, nao_model().num_motors() - 1);
  std::uniform_real_distribution<double> angle(-3, 3);
  std::map<int64_t, int> num_accepted;
  std::map<int64_t, int> num_final;
  const auto count = [&](const Output& output) {
    for (const CommandResult& result : output.results) {
      ++(is_final(result.status) ? num_final : num_accepted)[result.id];
    }
  };
  std::vector<double> last = robot_.sensors().position;
  constexpr int64_t kNumCommands = 10000;
  for (int64_t id = 1; id <= kNumCommands; ++id) {
    Command command;
    const auto& postures = nao_model().postures();
    const auto& actions = nao_model().actions();
    switch (pick(random)) {
      case 0:
        command = posture(id, postures[random() % postures.size()].name);
        break;
      case 1:
        command = posture(id, "Nowhere", angle(random));
        break;
      case 2:
        command = {"test", id, WalkCommand{angle(random), 0, kNan}};
        break;
      case 3:
        command = {"test", id, MoveToCommand{angle(random), 0, 0}};
        break;
      case 4:
        command = {"test", id,
                   ActionCommand{actions[random() % actions.size()].name, kNan, kNan, kNan}};
        break;
      case 5:
        command = {"test", id, StopCommand{}};
        break;
      default:
        command = joint_change(id, {nao_model().motor_joint(pick_motor(random)).name, "HeadYaw"},
                               {angle(random), angle(random)}, random() % 2 == 0, 1);
    }
    const int num_steps = static_cast<int>(random() % 4);
    for (int i = 0; i <= num_steps; ++i) {
      const Output output =
          robot_.step(core_, i == 0 ? std::vector<Command>{command} : std::vector<Command>{});
      count(output);
      const auto& targets = output.joint_targets->position;
      for (int motor = 0; motor < nao_model().num_motors(); ++motor) {
        const Joint& joint = nao_model().motor_joint(motor);
        ASSERT_LE(std::abs(targets[motor] - last[motor]), joint.max_velocity * 0.01 * (1 + 1e-9))
            << joint.name;
        ASSERT_GE(targets[motor], joint.lower - 1e-12);
        ASSERT_LE(targets[motor], joint.upper + 1e-12);
        ASSERT_NEAR(nao_model().clip_to_limits(motor, targets[motor], targets), targets[motor],
                    1e-9)
            << joint.name;
      }
      last = targets;
    }
  }
  // A path may be tried for minutes, since this robot never lies down.
  for (int i = 0; i < 30000 && core_.motion_state().mode != Mode::kHolding; ++i) {
    count(robot_.step(core_));
  }
  for (int64_t id = 1; id <= kNumCommands; ++id) {
    EXPECT_EQ(num_final[id], 1) << id;
    EXPECT_LE(num_accepted[id], 1) << id;
  }
}

TEST_F(MotionCoreTest, RefusesToTipAndTellsHowFarTheJointMayTurn) {
  robot_.settle(core_);
  const CommandResult result =
      refused(joint_change(1, {"LHipPitch", "RHipPitch"}, {0.9, 0.9}, true));
  EXPECT_EQ(result.reason.code, "tipping-backward") << result.reason;
  EXPECT_THAT(result.reason.arguments.at(0), testing::EndsWith("HipPitch"));
  EXPECT_GT(std::stoi(result.reason.arguments.at(1)), 0);
  Command allowed = joint_change(2, {"LHipPitch", "RHipPitch"}, {0.9, 0.9}, true);
  std::get<JointChangeCommand>(allowed.request).allow_tipping = true;
  EXPECT_EQ(robot_.step(core_, {allowed}).results.at(0).status, ResultStatus::kAccepted);
}

TEST_F(MotionCoreTest, AChangeThatWaitedIsCheckedAgainBeforeItStarts) {
  robot_ = PerfectRobot("Sit");
  robot_.settle(core_);
  robot_.step(core_, {posture(1, "StandInit")});
  for (int i = 0; i < 100; ++i) robot_.step(core_);
  // A robot that sits is not checked for tipping.
  const Output output =
      robot_.step(core_, {joint_change(2, {"LHipPitch", "RHipPitch"}, {0.9, 0.9}, true)});
  ASSERT_EQ(output.results.at(0).status, ResultStatus::kAccepted) << output.results.at(0).reason;
  const std::vector<CommandResult> results = robot_.settle(core_, 60);
  ASSERT_EQ(results.size(), 2u);
  EXPECT_EQ(results[0].id, 1);
  EXPECT_EQ(results[1].status, ResultStatus::kFailed);
  EXPECT_THAT(results[1].reason.code, testing::StartsWith("tipping-"));
  EXPECT_EQ(core_.motion_state().mode, Mode::kHolding);
}

TEST_F(MotionCoreTest, RefusesToCollideWithItself) {
  robot_.settle(core_);
  const CommandResult result = refused(joint_change(
      1, {"LShoulderPitch", "LShoulderRoll", "LElbowYaw", "LElbowRoll"}, {1.4, -0.31, -1.0, -1.5}));
  EXPECT_EQ(result.reason.code, "self-collision") << result.reason;
}

TEST_F(MotionCoreTest, AJointThatANewerSlowChangeDoesNotNameStopsAtOnce) {
  robot_.settle(core_);
  const int shoulder = nao_model().find_motor("LShoulderPitch");
  robot_.step(core_, {joint_change(1, {"LShoulderPitch"}, {-1.5})});
  for (int i = 0; i < 15; ++i) robot_.step(core_);
  const double left_at = robot_.sensors().position[shoulder];
  robot_.step(core_, {joint_change(2, {"HeadYaw"}, {0.6}, false, 0.05)});
  double farthest = 0;
  for (int i = 0; i < 200; ++i) {
    robot_.step(core_);
    farthest = std::max(farthest, std::abs(robot_.sensors().position[shoulder] - left_at));
  }
  EXPECT_LT(farthest, 0.3);
}

TEST_F(MotionCoreTest, WavesRestsAndWakesUp) {
  robot_.settle(core_);
  robot_.step(core_, {{"test", 1, ActionCommand{"wave", kNan, kNan, kNan}}});
  EXPECT_EQ(core_.motion_state().mode, Mode::kActing);
  ASSERT_EQ(robot_.settle(core_).size(), 1u);
  robot_.step(core_, {{"test", 2, ActionCommand{"rest", kNan, kNan, kNan}}});
  for (int i = 0; i < 1500 && core_.motion_state().mode != Mode::kRelaxed; ++i) robot_.step(core_);
  EXPECT_EQ(core_.motion_state().mode, Mode::kRelaxed);
  EXPECT_EQ(core_.motion_state().posture, "Crouch");
  EXPECT_EQ(core_.motion_state().stiffness, 0);
  EXPECT_EQ(refused(joint_change(3, {"HeadYaw"}, {0.5})).reason, Reason("robot-relaxed"));
  robot_.step(core_, {{"test", 4, ActionCommand{"wake-up", kNan, kNan, kNan}}});
  robot_.settle(core_);
  EXPECT_EQ(core_.motion_state().posture, "StandInit");
  EXPECT_EQ(core_.motion_state().stiffness, 1);
}

TEST_F(MotionCoreTest, AsksForHelpAfterSixTriesAndAcceptsACommandThen) {
  robot_.lie_on_belly();
  int num_tries = 0;
  const auto step = [&] {
    robot_.step(core_);
    num_tries = std::max(num_tries, core_.motion_state().num_tries);
    return core_.motion_state().needs_help;
  };
  int num_ticks = 0;
  while (num_ticks < 20000 && !step()) ++num_ticks;
  EXPECT_EQ(core_.motion_state().mode, Mode::kFallen);
  EXPECT_TRUE(core_.motion_state().needs_help);
  EXPECT_GE(num_tries, 6);
  for (int i = 0; i < 500; ++i) EXPECT_TRUE(step());
  const Command get_up = {"test", 1, ActionCommand{"get-up", kNan, kNan, kNan}};
  EXPECT_EQ(robot_.step(core_, {get_up}).results.at(0).status, ResultStatus::kAccepted);
  std::vector<CommandResult> results;
  for (int i = 0; i < 20000 && results.empty(); ++i) results = robot_.step(core_).results;
  ASSERT_EQ(results.size(), 1u);
  EXPECT_EQ(results[0].status, ResultStatus::kFailed);
  EXPECT_EQ(results[0].reason, Reason("get-up-failed", {"6"}));
}

}  // namespace
}  // namespace nao::motion
