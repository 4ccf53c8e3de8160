#include "sim/sim_core.h"

#include <gtest/gtest.h>

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
    options.robots = {"NAO", "OTHER"};
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

TEST_F(SimCoreTest, RejectsInvalidWorldCommandsWithASentence) {
  const double nan = std::nan("");
  const auto expect_rejected = [&](const WorldCommand& command, const std::string& part) {
    const std::string error = execute(command);
    EXPECT_NE(error.find(part), std::string::npos) << command.name << ": " << error;
  };
  expect_rejected(command("fly"), "unknown world command \"fly\"");
  for (const char* later : {"drag", "add-robot", "remove-robot"}) {
    expect_rejected(command(later), "not supported");
  }
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
  WorldCommand pace;
  pace.name = "set-pace";
  pace.pace = 1;
  core.take_world_command(pace, 0);
  EXPECT_NE(core.last_world_command().error, "");
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

}  // namespace
}  // namespace nao::sim
