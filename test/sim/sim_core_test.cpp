#include "sim/sim_core.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "common/error.h"

namespace nao::sim {
namespace {

class SimCoreTest : public testing::Test {
 protected:
  SimCoreTest() { core_.start(now_); }

  static SimOptions options() {
    SimOptions options;
    options.ideal_sensors = true;
    options.robots = {{"NAO", "nao"}, {"OTHER", "nao"}};
    return options;
  }

  WorldCommand command(const std::string& name) {
    WorldCommand command;
    command.source = "test";
    command.id = ++last_id_;
    command.name = name;
    return command;
  }
  /** @return Why the command was rejected; empty if it was executed. */
  std::string execute(const WorldCommand& command) {
    EXPECT_TRUE(core_.take_world_command(command, now_));
    EXPECT_EQ(core_.last_world_command().source, "test");
    EXPECT_EQ(core_.last_world_command().id, command.id);
    return core_.last_world_command().error;
  }
  /** Runs the ticks that are due within a duration, s. */
  void run(double duration) {
    const double end = now_ + duration;
    while (core_.may_tick()) {
      const double next = core_.next_tick(now_);
      if (next > end) break;
      now_ = next;
      core_.run_tick(now_);
    }
    now_ = end;
  }

  /** As run(). @return States that are sent. */
  int count_states(double duration) {
    const double end = now_ + duration;
    int num_states = 0;
    for (double next = core_.next_tick(now_); next <= end; next = core_.next_tick(now_)) {
      now_ = std::max(now_, next);
      core_.run_tick(now_);
      num_states += core_.is_state_due();
    }
    now_ = end;
    return num_states;
  }

  double now_ = 100;
  SimCore core_{options()};
  int64_t last_id_ = 0;
};

TEST_F(SimCoreTest, KeepsPaceWithTheClock) {
  run(1);
  EXPECT_NEAR(static_cast<double>(core_.world().tick()), 100, 1);
  WorldCommand slower = command("set-pace");
  slower.pace = 0.5;
  EXPECT_EQ(execute(slower), "");
  const int64_t tick = core_.world().tick();
  run(1);
  EXPECT_NEAR(static_cast<double>(core_.world().tick() - tick), 50, 1);
}

TEST_F(SimCoreTest, SendsTenStatesASecondAtRest) {
  run(RestDetector::kRestDelay + 1);
  const int64_t tick = core_.world().tick();
  EXPECT_EQ(count_states(1), 10);
  EXPECT_NEAR(static_cast<double>(core_.world().tick() - tick), 100, 10);
  EXPECT_EQ(core_.scheduler().num_late_ticks(), 0);
}

TEST_F(SimCoreTest, RunsWhatIsDueWhenATargetChangesAtRest) {
  run(RestDetector::kRestDelay + 1.02);
  const int64_t tick = core_.world().tick();
  now_ += 0.045;
  JointCommand command{tick, {"HeadYaw"}, {core_.world().targets(0).position[0]}, {1}};
  EXPECT_EQ(core_.take_joint_command(0, command, now_), std::nullopt);
  EXPECT_GT(core_.next_tick(now_), now_) << "no target has changed";
  command.position = {0.3};
  EXPECT_EQ(core_.take_joint_command(0, command, now_), std::nullopt);
  EXPECT_GE(count_states(0), 1);
  EXPECT_GE(core_.world().tick() - tick, 1);
  EXPECT_GE(count_states(1), 100);
}

TEST_F(SimCoreTest, RunsWhatIsDueWhenATickIsAnsweredAgainAtRest) {
  run(RestDetector::kRestDelay + 1.02);
  now_ += 0.045;
  const JointCommand command{core_.world().tick(), {}, {}, {}};
  EXPECT_EQ(core_.take_joint_command(0, command, now_), std::nullopt);
  EXPECT_GT(core_.next_tick(now_), now_);
  EXPECT_EQ(core_.take_joint_command(0, command, now_), std::nullopt);
  EXPECT_EQ(count_states(0), 1);
  EXPECT_NEAR(static_cast<double>(core_.world().tick() - command.tick), 6.5, 1);
  EXPECT_NEAR(count_states(1), 100, 1);
}

TEST_F(SimCoreTest, SendsAStateForEachImageAtRest) {
  run(RestDetector::kRestDelay + 1.02);
  now_ += 0.045;
  core_.take_image_request(now_);
  EXPECT_EQ(count_states(0), 1) << "the first image shows what was due";
  for (int i = 0; i < 4; ++i) {
    core_.take_image_request(now_);
    EXPECT_NEAR(count_states(1), 33, 1);
  }
  run(RestDetector::kRestDelay);
  EXPECT_EQ(count_states(1), 10);
  EXPECT_EQ(core_.scheduler().num_late_ticks(), 0);
}

TEST_F(SimCoreTest, DoesNotRestWhileAnythingMoves) {
  run(RestDetector::kRestDelay + 1);
  WorldCommand push = command("push");
  push.robot = "NAO";
  push.impulse = {0.5, 0, 0};
  EXPECT_EQ(execute(push), "");
  EXPECT_GE(count_states(1), 100);
  run(10);
  EXPECT_EQ(count_states(1), 10);
}

TEST_F(SimCoreTest, PausesStepsAndResumes) {
  EXPECT_EQ(execute(command("pause")), "");
  run(1);
  EXPECT_EQ(core_.world().tick(), 0);
  WorldCommand step = command("step");
  step.num_ticks = 7;
  EXPECT_EQ(execute(step), "");
  run(1);
  EXPECT_EQ(core_.world().tick(), 7);
  EXPECT_EQ(execute(command("resume")), "");
  run(0.1);
  EXPECT_NEAR(static_cast<double>(core_.world().tick()), 17, 1);
  EXPECT_EQ(execute(command("reset")), "");
  EXPECT_EQ(core_.world().tick(), 0);
}

TEST_F(SimCoreTest, IgnoresARepeatedCommand) {
  WorldCommand step = command("step");
  step.num_ticks = 1;
  EXPECT_TRUE(core_.take_world_command(step, now_));
  EXPECT_FALSE(core_.take_world_command(step, now_));
  run(1);
  EXPECT_EQ(core_.world().tick(), 1);
}

TEST_F(SimCoreTest, PlacesAndPushes) {
  WorldCommand place = command("place-robot");
  place.robot = "OTHER";
  place.posture = "LyingBack";
  place.position = {1, 2, 0};
  EXPECT_EQ(execute(place), "");
  EXPECT_EQ(core_.world().robot(1).state().position.head<2>(), Eigen::Vector2d(1, 2));
  EXPECT_LT(core_.world().robot(1).state().position.z(), 0.15);
  EXPECT_GT(core_.world().robot(0).state().position.z(), 0.3);

  WorldCommand ball = command("place-ball");
  ball.position = {2, 0, 0};
  ball.velocity = {0, 1, 0};
  EXPECT_EQ(execute(ball), "");
  EXPECT_EQ(core_.world().ball().position.x(), 2);

  WorldCommand push = command("push");
  push.link = "ball";
  push.impulse = {0.09, 0, 0};
  EXPECT_EQ(execute(push), "");
  run(0.011);
  EXPECT_GT(core_.world().ball().velocity.x(), 1);
}

TEST_F(SimCoreTest, ObeysNoAnswerToAnotherSimulator) {
  run(1.5);
  const int64_t tick = core_.world().tick();
  EXPECT_FALSE(core_.take_joint_command(0, {tick - 50, {}, {}, {}}, now_));
  EXPECT_TRUE(core_.take_joint_command(0, {tick - 101, {}, {}, {}}, now_));
  EXPECT_TRUE(core_.take_joint_command(0, {tick + 1, {}, {}, {}}, now_));
}

TEST_F(SimCoreTest, DragsALimpArmUntilTheCommandsEnd) {
  const RobotModel& model = core_.world().robot(0).model();
  const int wrist = model.find_link("LWrist");
  const auto wrist_in_torso = [&] {
    const SimRobot& robot = core_.world().robot(0);
    return Eigen::Vector3d(robot.link_pose(0).inverse() * robot.link_pose(wrist).translation());
  };
  for (const char* joint : {"LShoulderPitch", "LShoulderRoll", "LElbowYaw", "LElbowRoll"}) {
    ASSERT_FALSE(core_.take_joint_command(0, {core_.world().tick(), {joint}, {0}, {0}}, now_));
  }
  run(1.5);
  const Eigen::Vector3d hanging = wrist_in_torso();
  const Eigen::Vector3d target(0.15, 0.15, 0.1);
  for (int i = 0; i < 30; ++i) {
    WorldCommand drag = command("drag-in-torso");
    drag.link = "LWrist";
    drag.target = target;
    ASSERT_EQ(execute(drag), "");
    run(0.1);
  }
  EXPECT_LT((wrist_in_torso() - target).norm(), 0.03);
  run(2);
  // Friction stops the joints before the arm hangs as it did.
  EXPECT_LT((wrist_in_torso() - hanging).norm(), 0.1);
}

TEST_F(SimCoreTest, RejectsInvalidWorldCommandsWithASentence) {
  const double nan = std::nan("");
  const auto expect_rejected = [&](const WorldCommand& command, const std::string& part) {
    const std::string error = execute(command);
    EXPECT_NE(error.find(part), std::string::npos) << command.name << ": " << error;
  };
  expect_rejected(command("fly"), "unknown world command \"fly\"");
  expect_rejected(command("add-robot"), "a robot's name consists of");
  expect_rejected(command("remove-robot"), "there is no robot \"\"");
  expect_rejected(command("step"), "1 or more");
  WorldCommand wrong = command("set-pace");
  wrong.pace = -1;
  expect_rejected(wrong, "pace -1 is outside [0, 1000]");
  wrong = command("place-robot");
  wrong.robot = "NOBODY";
  expect_rejected(wrong, "no robot \"NOBODY\"");
  wrong = command("place-robot");
  wrong.posture = "Headstand";
  expect_rejected(wrong, "no posture \"Headstand\"");
  wrong = command("place-robot");
  wrong.position.z() = -1;
  expect_rejected(wrong, "below the floor");
  wrong = command("place-robot");
  wrong.orientation[0] = 5;
  expect_rejected(wrong, "unit quaternion");
  wrong = command("place-ball");
  wrong.velocity.x() = nan;
  expect_rejected(wrong, "velocity (nan, 0, 0)");
  wrong = command("drag");
  wrong.link = "Tail";
  expect_rejected(wrong, "no link \"Tail\"");
  wrong = command("drag");
  wrong.link = "LWrist";
  wrong.point.x() = 2;
  expect_rejected(wrong, "within 1 m");
  wrong = command("drag");
  wrong.link = "LWrist";
  wrong.target.z() = nan;
  expect_rejected(wrong, "target (0, 0, nan)");
  wrong = command("push");
  wrong.link = "Tail";
  expect_rejected(wrong, "no link \"Tail\"");
  wrong = command("push");
  wrong.link = "torso";
  wrong.impulse.x() = 101;
  expect_rejected(wrong, "within 100 N s");
}

TEST_F(SimCoreTest, SetsTargetsOfTheNamedJoints) {
  ASSERT_FALSE(core_.take_joint_command(1, {0, {"HeadYaw"}, {0.5}, {1}}, now_));
  const int motor = core_.world().robot(1).model().find_motor("HeadYaw");
  EXPECT_EQ(core_.world().targets(1).position[motor], 0.5);
  EXPECT_EQ(core_.world().targets(0).position[motor], 0);
  const auto unknown = core_.take_joint_command(1, {0, {"Tail"}, {0}, {1}}, now_);
  ASSERT_TRUE(unknown);
  EXPECT_NE(unknown->find("Tail"), std::string::npos);
  const auto future = core_.take_joint_command(1, {1, {"HeadYaw"}, {0}, {1}}, now_);
  ASSERT_TRUE(future);
  EXPECT_NE(future->find("tick 1"), std::string::npos);
}

TEST(SimCore, RunsInLockStepWithTheJointCommands) {
  SimOptions options;
  options.lock_step = true;
  SimCore core(options);
  for (int64_t tick = 0; tick < 10; ++tick) {
    EXPECT_FALSE(core.may_tick());
    ASSERT_FALSE(core.take_joint_command(0, {tick, {}, {}, {}}, 0));
    ASSERT_TRUE(core.may_tick());
    EXPECT_LE(core.next_tick(0), 0);
    core.run_tick(0);
  }
  // A pace is a limit: programs with timers of the wall clock drive at, say, three times real time.
  WorldCommand pace;
  pace.name = "set-pace";
  pace.pace = 4;
  core.take_world_command(pace, 0);
  EXPECT_EQ(core.last_world_command().error, "");
  EXPECT_FALSE(core.may_tick());
  ASSERT_FALSE(core.take_joint_command(0, {10, {}, {}, {}}, 0));
  ASSERT_TRUE(core.may_tick());
  EXPECT_DOUBLE_EQ(core.next_tick(0), 0.0025);
  // An answer that comes later than that delays the tick, which is not late.
  core.run_tick(0.02);
  EXPECT_EQ(core.scheduler().num_late_ticks(), 0);
}

TEST(SimCore, RunsAtTheControlPeriodOfItsOptions) {
  SimOptions options;
  options.tick_ms = 12;
  SimCore core(options);
  core.run_tick(0.012);
  EXPECT_EQ(core.world().options().steps_per_tick, 6);
  EXPECT_EQ(core.world().sensors(0).time, 0.012);
  EXPECT_NEAR(core.world().time(), 0.012, 1e-12);
  EXPECT_NEAR(core.next_tick(0.012), 0.024, 1e-12);
  for (const int invalid : {0, 1, 11, 102, -2}) {
    options.tick_ms = invalid;
    EXPECT_THROW(SimCore{options}, ConfigError) << invalid;
  }
}

TEST_F(SimCoreTest, ObeysLightCommandsForEachRobotAndForgetsThemWithAReset) {
  const auto index = [&](const std::string& name) {
    const std::vector<std::string>& names = core_.lights(0).names();
    return static_cast<size_t>(std::find(names.begin(), names.end(), name) - names.begin());
  };
  const LightColor red{1, 0, 0};
  const LightColor blue{0, 0, 1};
  const LightColor dark{};
  EXPECT_EQ(core_.lights(0).color(index("chest")), dark);
  EXPECT_EQ(core_.take_light_command(0, {{"chest"}, {red}, 0}), std::nullopt);
  EXPECT_EQ(core_.take_light_command(0, {{"left-eye"}, {blue}, 0.1}), std::nullopt);
  EXPECT_EQ(core_.take_light_command(0, {{"tail"}, {red}, 0})->code, "light-unknown");
  run(0.05);
  EXPECT_EQ(core_.lights(0).color(index("chest")), red);
  EXPECT_EQ(core_.lights(0).color(index("left-eye")), blue);
  EXPECT_EQ(core_.lights(1).color(index("chest")), dark);
  run(0.1);
  EXPECT_EQ(core_.lights(0).color(index("left-eye")), dark);
  EXPECT_EQ(execute(command("reset")), "");
  EXPECT_EQ(core_.lights(0).color(index("chest")), dark);
}

TEST(SimCore, HasTwoTeamsThatFaceEachOtherAndTheBallBetweenThem) {
  SimOptions options;
  options.robots = {{"NAO1", "nao"}, {"NAO2", "nao"}, {"NAO3", "nao"}, {"NAO4", "nao"}};
  const SimCore core(options);
  EXPECT_EQ(core.world().ball().position.head<2>(), Eigen::Vector2d::Zero());
  for (int i = 0; i < 4; ++i) {
    const RobotOption& player = core.options().robots[static_cast<size_t>(i)];
    EXPECT_EQ(player.team, i / 2);
    EXPECT_EQ(player.number, i % 2 + 1);
    const TreeState& state = core.world().robot(i).state();
    const double toward_center = (state.orientation * Eigen::Vector3d::UnitX()).x();
    EXPECT_NEAR(toward_center, i < 2 ? 1 : -1, 0.01);
    EXPECT_LT(toward_center * state.position.x(), -0.8);
  }
}

TEST(SimCore, AddsAndRemovesRobotsWhileItRuns) {
  SimOptions options;
  options.ideal_sensors = true;
  options.lock_step = true;
  options.robots = {{"A", "nao"}, {"B", "nao"}, {"C", "nao"}};
  SimCore core(options);
  int64_t last_id = 0;
  const auto execute = [&](const std::string& name, const std::string& robot, double x,
                           const std::string& model = "") {
    WorldCommand command;
    command.source = "test";
    command.id = ++last_id;
    command.name = name;
    command.robot = robot;
    command.model = model;
    command.position.x() = x;
    core.take_world_command(command, 0);
    return core.last_world_command().error;
  };
  // Every robot answers.
  const auto run = [&](int num_ticks) {
    for (int i = 0; i < num_ticks; ++i) {
      for (int robot = 0; robot < core.world().num_robots(); ++robot) {
        const int64_t tick = core.world().sensors(robot).tick;
        ASSERT_EQ(tick, core.world().tick());
        ASSERT_FALSE(core.may_tick());
        ASSERT_FALSE(core.take_joint_command(robot, {tick, {}, {}, {}}, 0));
      }
      ASSERT_TRUE(core.may_tick());
      core.run_tick(0);
    }
  };
  run(50);
  EXPECT_EQ(execute("add-robot", "D", 2, "t1"), "");
  EXPECT_EQ(execute("add-robot", "E", -2), "");
  ASSERT_EQ(core.world().num_robots(), 5);
  EXPECT_EQ(core.world().sensors(3).time, core.world().sensors(0).time);
  run(50);
  EXPECT_EQ(execute("remove-robot", "B", 0), "");
  EXPECT_EQ(execute("remove-robot", "A", 0), "");
  ASSERT_EQ(core.world().num_robots(), 3);
  EXPECT_EQ(core.find_robot("C"), 0);
  EXPECT_EQ(core.find_robot("D"), 1);
  EXPECT_EQ(core.find_robot("A"), -1);
  const double place = core.world().robot(1).state().position.x();
  run(200);
  EXPECT_NEAR(core.world().robot(1).state().position.x(), place, 0.02);
  EXPECT_GT(core.world().robot(0).state().position.z(), 0.3);
  EXPECT_GT(core.world().robot(1).state().position.z(), 0.5);
  EXPECT_GT(core.world().robot(2).state().position.z(), 0.3);
  EXPECT_FALSE(core.world().contacts().empty());
  // The same name again, at the place of another one that has left.
  EXPECT_EQ(execute("add-robot", "A", 0), "");
  run(100);
  EXPECT_EQ(execute("reset", "", 0), "");
  run(20);
  EXPECT_NEAR(core.world().robot(1).state().position.x(), 2, 0.1);

  EXPECT_NE(execute("add-robot", "D", 4), "") << "the name is taken";
  EXPECT_NE(execute("add-robot", "lower case", 4), "");
  EXPECT_NE(execute("add-robot", "F", 2.1), "") << "D stands there";
  EXPECT_NE(execute("add-robot", "F", 4, "../robots/nao"), "");
  EXPECT_NE(execute("add-robot", "F", 4, "r2d2"), "");
  EXPECT_NE(execute("remove-robot", "F", 0), "");
  EXPECT_NE(execute("remove-robot", "", 0), "");
  for (const char* name : {"C", "D", "E"}) EXPECT_EQ(execute("remove-robot", name, 0), "");
  EXPECT_NE(execute("remove-robot", "A", 0), "") << "the last one";
  run(20);
}

TEST(SimCore, HasRobotsOfDifferentModelsThatStand) {
  SimOptions options;
  options.robots = {{"A", "nao"}, {"B", "t1"}, {"C", "nao_v6"}};
  SimCore core(options);
  const auto height = [&](int robot) { return core.world().robot(robot).state().position.z(); };
  const double before[] = {height(0), height(1), height(2)};
  for (int tick = 0; tick < 200; ++tick) core.run_tick(0.01 * (tick + 1));
  for (int robot = 0; robot < 3; ++robot) EXPECT_NEAR(height(robot), before[robot], 0.02);
  EXPECT_NE(core.world().robot(0).model().num_motors(), core.world().robot(1).model().num_motors());

  WorldCommand push;
  push.source = "test";
  push.id = 1;
  push.name = "push";
  push.robot = "B";
  push.impulse = {5, 0, 0};
  core.take_world_command(push, 2);
  EXPECT_EQ(core.last_world_command().error, "");
  core.run_tick(2.01);
  EXPECT_GT(core.world().robot(1).state().velocity[3], 0.05);
  EXPECT_LT(std::abs(core.world().robot(0).state().velocity[3]), 0.01);
}

}  // namespace
}  // namespace nao::sim
