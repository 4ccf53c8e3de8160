#include "sim/lola_robot.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "common/error.h"
#include "sim/sim_core.h"
#include "test/sim/sim_fixture.h"

namespace nao::sim {
namespace {

SimOptions lola_options() {
  SimOptions options;
  options.scene = "empty";
  options.lock_step = true;
  options.tick_ms = 12;
  options.lola_socket = "none";
  return options;
}

class SimulatedLola : public testing::Test {
 protected:
  /** One command, one frame. */
  const LolaState& answer(const LolaCommand& command) {
    core_.take_lola_command(command, 0);
    EXPECT_TRUE(core_.may_tick());
    core_.run_tick(0);
    EXPECT_FALSE(core_.may_tick());
    return core_.lola()->state();
  }

  SimCore core_{lola_options()};
};

TEST_F(SimulatedLola, HasAFrameBeforeTheFirstCommand) {
  const LolaState& state = core_.lola()->state();
  EXPECT_NEAR(state.accelerometer[2], -9.81, 0.5);
  EXPECT_THAT(state.stiffness, testing::Each(1));
  EXPECT_FALSE(core_.may_tick());
}

TEST(SimulatedLolaServos, DifferByTheirDisturbance) {
  const auto moved = [](const std::string& disturbances) {
    SimOptions options = lola_options();
    options.disturbances = disturbances;
    SimCore core(options);
    LolaCommand command;
    command.position = core.lola()->state().position;
    for (float& position : *command.position) position += 0.1f;
    for (int i = 0; i < 6; ++i) {
      core.take_lola_command(command, 0);
      core.run_tick(0);
    }
    return core.lola()->state().position;
  };
  const auto nominal = moved("sensor_loss");
  const auto stiff = moved("servo_stiffness,sensor_loss");
  const auto damped = moved("servo_damping,sensor_loss");
  EXPECT_GT(std::abs(stiff[0] - nominal[0]), 1e-3);
  EXPECT_GT(std::abs(damped[0] - nominal[0]), 1e-3);
}

TEST_F(SimulatedLola, EveryCommandIsOneFrameInLockStep) {
  const int64_t tick = core_.world().tick();
  for (int i = 1; i <= 10; ++i) {
    answer({});
    EXPECT_EQ(core_.world().tick(), tick + i);
  }
}

TEST_F(SimulatedLola, AnEmptyCommandKeepsWhatWasSet) {
  LolaCommand command;
  command.position = core_.lola()->state().position;
  (*command.position)[0] = 0.5f;
  command.stiffness.emplace().fill(0.5f);
  command.chest = {1, 0, 0};
  answer(command);
  for (int i = 0; i < 100; ++i) answer({});
  const LolaState& state = core_.lola()->state();
  EXPECT_NEAR(state.position[0], 0.5, 0.03);
  EXPECT_THAT(state.stiffness, testing::Each(0.5f));
  EXPECT_THAT(light_color(core_.lola()->held(), "Chest"), testing::ElementsAre(1, 0, 0));
}

TEST_F(SimulatedLola, IgnoresNumbersThatAreNotFiniteAndLimitsStiffness) {
  LolaCommand command;
  const float nan = std::numeric_limits<float>::quiet_NaN();
  command.position.emplace().fill(nan);
  command.stiffness.emplace().fill(2);
  (*command.stiffness)[0] = -1;
  (*command.stiffness)[1] = nan;
  const auto before = core_.world().targets(0).position;
  answer(command);
  EXPECT_LT((core_.world().targets(0).position - before).norm(), 1e-5);
  EXPECT_EQ(core_.lola()->state().stiffness[0], 0);
  EXPECT_EQ(core_.lola()->state().stiffness[1], 1);
  EXPECT_EQ(core_.lola()->state().stiffness[2], 1);
}

TEST_F(SimulatedLola, MotorsUnderLoadDrawCurrentAndGetWarm) {
  LolaState state;
  for (int i = 0; i < 2000; ++i) state = answer({});
  const auto knee = 10;
  EXPECT_GT(state.current[knee], 0.1);
  EXPECT_GT(state.temperature[knee], 38);
  EXPECT_LT(state.temperature[knee], 60);
  EXPECT_LT(state.battery[2], 0);
}

TEST_F(SimulatedLola, SonarsSeeNothingUntilTheyAreSwitchedOn) {
  EXPECT_THAT(answer({}).sonar, testing::Each(0));
  LolaCommand command;
  command.sonar = {true, false};
  EXPECT_THAT(answer(command).sonar, testing::ElementsAre(testing::Gt(1), 0));
}

TEST_F(SimulatedLola, ButtonsArePressedByTheWorld) {
  WorldCommand command;
  command.source = "test";
  command.id = 1;
  command.name = "touch";
  command.link = "chest-button";
  command.num_ticks = 2;
  ASSERT_TRUE(core_.take_world_command(command, 0));
  EXPECT_EQ(core_.last_world_command().error, "");
  EXPECT_EQ(answer({}).touch[0], 1);
  EXPECT_EQ(answer({}).touch[0], 1);
  EXPECT_EQ(answer({}).touch[0], 0);
  command.id = 2;
  command.link = "tail";
  core_.take_world_command(command, 0);
  EXPECT_THAT(core_.last_world_command().error, testing::HasSubstr("\"tail\""));
}

TEST(SimCoreWithLola, ServesOneRobotThatHasTheFile) {
  SimOptions options = lola_options();
  options.robots = {{"NAO", "nao"}, {"NAO2", "nao"}};
  EXPECT_THROW(SimCore{options}, ConfigError);
  options = lola_options();
  options.robots = {{"NAO", "t1"}};
  EXPECT_THROW(SimCore{options}, ModelError);
}

}  // namespace
}  // namespace nao::sim
