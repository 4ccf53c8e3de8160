// nao-sim as a process, tested over the bus.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>
#include <naolcm/daemon_status_t.hpp>
#include <naolcm/joint_command_t.hpp>
#include <naolcm/sensor_state_t.hpp>
#include <naolcm/world_command_t.hpp>
#include <naolcm/world_truth_t.hpp>
#include <optional>
#include <string>

#include "common/bus.h"
#include "common/channels.h"
#include "common/random.h"
#include "common/wall_clock.h"
#include "sim/message_conversion.h"
#include "sim/world.h"
#include "test/sim/sim_fixture.h"
#include "test/support/child_program.h"
#include "test/support/num_waits.h"

namespace nao::sim {
namespace {

/** Time-out of everything that is waited for, s: far longer than it takes on a busy machine. */
constexpr double kTimeout = 60;

naolcm::joint_command_t command(int64_t tick, const std::vector<std::string>& names,
                                const std::vector<double>& position,
                                const std::vector<double>& stiffness) {
  naolcm::joint_command_t message;
  message.utime = tick * 10000;
  message.tick = tick;
  message.num_joints = static_cast<int>(names.size());
  message.joint_names = names;
  message.joint_position = position;
  message.joint_stiffness = stiffness;
  const double nan = std::nan("");
  message.joint_velocity.assign(names.size(), nan);
  message.joint_torque.assign(names.size(), 0);
  message.joint_kp.assign(names.size(), nan);
  message.joint_kd.assign(names.size(), nan);
  return message;
}

class SimProgram : public testing::Test {
 protected:
  SimProgram() : bus_(private_bus_url()) {
    bus_.subscribe<naolcm::world_truth_t>(
        kWorldTruthChannel, Bus::Queue::kLatest,
        [this](const naolcm::world_truth_t& message) { truth_ = message; });
    bus_.subscribe<naolcm::daemon_status_t>(
        kDaemonStatusChannel, Bus::Queue::kLatest,
        [this](const naolcm::daemon_status_t& message) { status_ = message; });
    bus_.subscribe<naolcm::sensor_state_t>(RobotChannels().sensor_state, Bus::Queue::kAll,
                                           [this](const naolcm::sensor_state_t& message) {
                                             sensors_ = message;
                                             if (on_sensors_) on_sensors_(message);
                                           });
  }

  void start(std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), {"--lcm-url", private_bus_url(), "--log-level", "warning"});
    program_.emplace("nao-sim", arguments);
  }

  /** Handles messages until a condition holds. */
  bool wait_for(const std::function<bool()>& condition) {
    const double end = monotonic_seconds() + kTimeout;
    while (!condition()) {
      if (monotonic_seconds() > end) return false;
      bus_.handle_for(0.1);
    }
    return true;
  }

  /** Repeats a world command until it is answered. @return Why it was rejected; empty if it was
   * executed. */
  std::string ask(naolcm::world_command_t message) {
    message.source = "test";
    message.command_id = ++last_id_;
    const bool is_answered = wait_for([&] {
      bus_.publish(kWorldCommandChannel, message);
      return truth_ && truth_->last_command_id == message.command_id;
    });
    return is_answered ? truth_->last_command_error : "no answer";
  }
  std::string ask(const std::string& name) {
    naolcm::world_command_t message{};
    message.command = name;
    return ask(message);
  }

  Bus bus_;
  std::optional<ChildProgram> program_;
  std::optional<naolcm::world_truth_t> truth_;
  std::optional<naolcm::daemon_status_t> status_;
  std::optional<naolcm::sensor_state_t> sensors_;
  std::function<void(const naolcm::sensor_state_t&)> on_sensors_;
  int64_t last_id_ = 0;
};

TEST_F(SimProgram, IsReadyAndKeepsPaceWithTheWallClock) {
  start({});
  ASSERT_TRUE(wait_for([&] { return status_ && status_->state == "ready" && sensors_ && truth_; }));
  EXPECT_EQ(sensors_->num_joints, nao_model()->num_motors());
  EXPECT_EQ(sensors_->num_foot_sensors, 8);
  EXPECT_EQ(truth_->scene, "soccer");
  ASSERT_TRUE(wait_for([&] { return truth_->tick > 300; }));
  const int64_t tick = truth_->tick;
  const double start_time = monotonic_seconds();
  ASSERT_TRUE(wait_for([&] { return truth_->tick >= tick + 500; }));
  const double took = monotonic_seconds() - start_time;
  EXPECT_NEAR(static_cast<double>(truth_->tick - tick) * 0.01 / took, 1, 0.2);
  EXPECT_NEAR(truth_->robots[0].position_torso_in_world[2], 0.32, 0.005);
  EXPECT_EQ(program_->end(), 0);
}

TEST_F(SimProgram, IsWokenByTicksAndNotByTheirAnswers) {
  on_sensors_ = [this](const naolcm::sensor_state_t& sensors) {
    // Another target each time: the world does not rest.
    bus_.publish(RobotChannels().joint_command,
                 command(sensors.tick, {"HeadYaw"}, {sensors.tick % 2 == 0 ? 0.1 : -0.1}, {1}));
  };
  start({});
  ASSERT_TRUE(wait_for([&] { return sensors_ && sensors_->tick >= 100; }));
  const int64_t tick = sensors_->tick;
  const int before = num_waits(program_->pid());
  ASSERT_TRUE(wait_for([&] { return sensors_->tick >= tick + 200; }));
  EXPECT_LT(num_waits(program_->pid()) - before, 1.5 * static_cast<double>(sensors_->tick - tick));
}

TEST_F(SimProgram, RejectsInvalidJointCommandsAndNothingMoves) {
  start({"--scene", "empty", "--ideal-sensors"});
  ASSERT_TRUE(wait_for([&] { return truth_ && truth_->tick > 200; }));
  const double nan = std::nan("");
  const double before = truth_->robots[0].joint_position[0];
  ASSERT_EQ(truth_->robots[0].joint_names[0], "HeadYaw");
  const std::string channel = RobotChannels().joint_command;
  bus_.publish(channel, command(0, {"HeadYaw", "Tail"}, {1, 1}, {1, 1}));
  bus_.publish(channel, command(0, {"HeadYaw", "HeadPitch"}, {1, nan}, {1, 1}));
  bus_.publish(channel, command(0, {"HeadYaw", "HeadPitch"}, {1, 0}, {1, 1.5}));
  bus_.publish(channel, *sensors_);  // Another type.
  ASSERT_TRUE(wait_for([&] { return status_ && status_->num_messages_dropped >= 4; }));
  const int64_t tick = truth_->tick;
  ASSERT_TRUE(wait_for([&] { return truth_->tick > tick + 50; }));
  EXPECT_NEAR(truth_->robots[0].joint_position[0], before, 1e-3);
  bus_.publish(channel, command(0, {"HeadYaw"}, {1}, {1}));
  EXPECT_TRUE(wait_for([&] { return truth_->robots[0].joint_position[0] > 0.9; }));
}

TEST_F(SimProgram, ExecutesWorldCommands) {
  start({"--ideal-sensors"});
  ASSERT_TRUE(wait_for([&] { return truth_.has_value(); }));
  EXPECT_EQ(ask("pause"), "");
  const int64_t tick = truth_->tick;
  EXPECT_TRUE(truth_->is_paused);

  naolcm::world_command_t message{};
  message.command = "step";
  message.num_ticks = 7;
  EXPECT_EQ(ask(message), "");
  ASSERT_TRUE(wait_for([&] { return truth_->tick == tick + 7; }));

  message = {};
  message.command = "place-ball";
  message.position_in_world[0] = 2;
  message.velocity_in_world[1] = 1;
  EXPECT_EQ(ask(message), "");
  EXPECT_EQ(truth_->position_ball_in_world[0], 2);

  message = {};
  message.command = "place-robot";
  message.posture = "LyingBack";
  message.position_in_world[1] = 1;
  EXPECT_EQ(ask(message), "");
  EXPECT_EQ(truth_->robots[0].position_torso_in_world[1], 1);
  EXPECT_LT(truth_->robots[0].position_torso_in_world[2], 0.15);

  message = {};
  message.command = "push";
  message.link = "ball";
  message.impulse_in_world[0] = 0.09;
  EXPECT_EQ(ask(message), "");
  message.command = "step";
  message.num_ticks = 1;
  EXPECT_EQ(ask(message), "");
  ASSERT_TRUE(wait_for([&] { return truth_->velocity_ball_in_world[0] > 1; }));

  EXPECT_NE(ask("fly"), "");
  EXPECT_NE(ask("drag"), "");
  message = {};
  message.command = "push";
  message.link = "Tail";
  EXPECT_NE(ask(message), "");
  message.link = "torso";
  message.impulse_in_world[0] = std::nan("");
  EXPECT_NE(ask(message), "");
  message = {};
  message.command = "place-robot";
  message.orientation_in_world[0] = 5;
  EXPECT_NE(ask(message), "");
  message = {};
  message.command = "set-pace";
  message.pace = -1;
  EXPECT_NE(ask(message), "");

  EXPECT_EQ(ask("reset"), "");
  ASSERT_TRUE(wait_for([&] { return truth_->tick == 0; }));
  EXPECT_NEAR(truth_->robots[0].position_torso_in_world[2], 0.32, 0.005);
  message = {};
  message.command = "set-pace";
  message.pace = 0;
  EXPECT_EQ(ask(message), "");
  EXPECT_EQ(ask("resume"), "");
  EXPECT_TRUE(wait_for([&] { return truth_->tick > 1000; }));
}

TEST_F(SimProgram, ReportsABadStateAndDoesNotPublishIt) {
  start({"--scene", "empty"});
  ASSERT_TRUE(wait_for([&] { return status_ && status_->state == "ready" && truth_; }));
  const auto bad_states = [&] {
    for (int i = 0; status_ && i < status_->num_metrics; ++i) {
      if (status_->metric_names[i] == "bad_states") return status_->metric_values[i];
    }
    return 0.0;
  };
  double fastest = 0;
  bus_.subscribe<naolcm::world_truth_t>(
      kWorldTruthChannel, Bus::Queue::kAll, [&](const naolcm::world_truth_t& message) {
        for (const double speed : message.robots[0].joint_velocity) {
          fastest = std::max(fastest, std::abs(speed));
        }
        for (const double speed : message.robots[0].velocity_torso_in_world) {
          fastest = std::max(fastest, std::abs(speed));
        }
      });
  // The forearm alone would leave at some 500 m/s.
  naolcm::world_command_t message{};
  message.command = "push";
  message.link = "LWrist";
  message.impulse_in_world[2] = 100;
  EXPECT_EQ(ask(message), "");
  EXPECT_TRUE(wait_for([&] { return bad_states() == 1; }));
  EXPECT_NEAR(truth_->robots[0].position_torso_in_world[2], 0.32, 0.01);
  EXPECT_LT(fastest, 300);
  const int64_t tick = truth_->tick;
  EXPECT_TRUE(wait_for([&] { return truth_->tick > tick + 100; }));
  EXPECT_EQ(bad_states(), 1);
}

/** Answer to a tick in the determinism test: new targets of all joints in one tick of six. */
naolcm::joint_command_t answer_to(int64_t tick) {
  if (tick % 6 != 0) return command(tick, {}, {}, {});
  Random random(static_cast<uint64_t>(tick));
  std::vector<std::string> names;
  std::vector<double> position;
  std::vector<double> stiffness;
  for (int i = 0; i < nao_model()->num_motors(); ++i) {
    const Joint& joint = nao_model()->motor_joint(i);
    names.push_back(joint.name);
    position.push_back(random.uniform(joint.lower, joint.upper));
    stiffness.push_back(random.uniform());
  }
  return command(tick, names, position, stiffness);
}

/** Numbers of a sensor state as bytes. */
std::string bits_of(const std::vector<double>& position, const double* gyroscope,
                    const double* orientation) {
  std::string result(reinterpret_cast<const char*>(position.data()),
                     position.size() * sizeof(double));
  result.append(reinterpret_cast<const char*>(gyroscope), 3 * sizeof(double));
  result.append(reinterpret_cast<const char*>(orientation), 4 * sizeof(double));
  return result;
}

constexpr int kDeterminismTicks = 6000;

TEST_F(SimProgram, LockStepGivesTheSameBitsInTwoProcessesAndWithoutABus) {
  std::vector<std::string> runs[2];
  for (std::vector<std::string>& states : runs) {
    on_sensors_ = [&](const naolcm::sensor_state_t& message) {
      // A state is repeated when an answer is late, and so is the answer.
      if (message.tick == static_cast<int64_t>(states.size())) {
        states.push_back(bits_of(message.joint_position, message.gyroscope_torso,
                                 message.orientation_torso_in_world));
      }
      bus_.publish(RobotChannels().joint_command, answer_to(message.tick));
    };
    start({"--lock-step", "--seed", "42"});
    const double end = monotonic_seconds() + 5 * kTimeout;
    while (states.size() <= kDeterminismTicks && monotonic_seconds() < end) bus_.handle_for(0.1);
    ASSERT_GT(states.size(), static_cast<size_t>(kDeterminismTicks));
    states.resize(kDeterminismTicks);
    on_sensors_ = nullptr;
    program_.reset();
    while (bus_.handle_for(0.05)) {
    }
  }
  EXPECT_TRUE(runs[0] == runs[1]);

  WorldOptions options;
  options.seed = 42;
  World world(SceneFile::find("soccer"), options);
  world.add_robot(nao_model());
  MotorTargets targets = world.targets(0);
  for (int tick = 0; tick < kDeterminismTicks; ++tick) {
    const SensorReadings& sensed = world.sensors(0);
    const double orientation[] = {sensed.orientation.w(), sensed.orientation.x(),
                                  sensed.orientation.y(), sensed.orientation.z()};
    const std::vector<double> position(sensed.position.data(),
                                       sensed.position.data() + sensed.position.size());
    ASSERT_TRUE(bits_of(position, sensed.gyroscope.data(), orientation) == runs[0][tick])
        << "tick " << tick;
    const naolcm::joint_command_t answer = answer_to(tick);
    ASSERT_FALSE(merge_joint_command(*nao_model(), to_core(answer), targets));
    world.set_targets(0, targets);
    world.step_tick();
  }
}

TEST_F(SimProgram, RunsAtAnotherControlPeriod) {
  start({"--lock-step", "--tick-ms", "12"});
  on_sensors_ = [&](const naolcm::sensor_state_t& message) {
    bus_.publish(RobotChannels().joint_command, command(message.tick, {}, {}, {}));
  };
  ASSERT_TRUE(wait_for([&] { return sensors_ && sensors_->tick >= 100; }));
  EXPECT_EQ(sensors_->period, 0.012);
  EXPECT_EQ(sensors_->utime, sensors_->tick * 12000);
  EXPECT_EQ(truth_->robots.at(0).model, "nao");
}

TEST_F(SimProgram, AnswersEveryRobotOnItsOwnChannels) {
  start({"--lock-step", "--robot", "NAO", "--robot", "NAO2", "--robot", "BIG:t1"});
  std::map<std::string, naolcm::sensor_state_t> others;
  const auto answer = [&](const std::string& robot, const naolcm::sensor_state_t& sensed) {
    bus_.publish(RobotChannels(robot).joint_command, command(sensed.tick, {}, {}, {}));
  };
  on_sensors_ = [&](const naolcm::sensor_state_t& sensed) { answer("NAO", sensed); };
  bool is_last_answered = false;
  for (const std::string robot : {"NAO2", "BIG"}) {
    bus_.subscribe<naolcm::sensor_state_t>(RobotChannels(robot).sensor_state, Bus::Queue::kAll,
                                           [&, robot](const naolcm::sensor_state_t& sensed) {
                                             others[robot] = sensed;
                                             if (robot != "BIG" || is_last_answered)
                                               answer(robot, sensed);
                                           });
  }
  ASSERT_TRUE(
      wait_for([&] { return status_ && status_->detail == "waiting for BIG_JOINT_COMMAND"; }));
  EXPECT_EQ(truth_->tick, 0);
  is_last_answered = true;
  ASSERT_TRUE(wait_for([&] { return truth_->tick > 100; }));
  EXPECT_NE(others["BIG"].num_joints, sensors_->num_joints);
  ASSERT_EQ(truth_->num_robots, 3);
  EXPECT_EQ(truth_->robots[1].robot, "NAO2");
  EXPECT_EQ(truth_->robots[1].model, "nao");
  EXPECT_EQ(truth_->robots[2].model, "t1");
  EXPECT_EQ(truth_->robots[2].number, 0) << "no match";

  naolcm::world_command_t message{};
  message.command = "place-robot";
  message.robot = "NAO2";
  message.position_in_world[0] = 2;
  EXPECT_EQ(ask(message), "");
  EXPECT_NEAR(truth_->robots[1].position_torso_in_world[0], 2, 0.01);
  EXPECT_NEAR(truth_->robots[0].position_torso_in_world[0], 0, 0.05);
  message.robot = "NAO3";
  EXPECT_NE(ask(message), "");
}

TEST_F(SimProgram, AddsARobotThatObeysAndRemovesIt) {
  start({});
  ASSERT_TRUE(wait_for([&] { return truth_ && truth_->tick > 10; }));
  naolcm::world_command_t message{};
  message.command = "add-robot";
  message.robot = "NEW";
  message.position_in_world[0] = -1;
  for (int round = 0; round < 2; ++round) {
    EXPECT_EQ(ask(message), "");
    ASSERT_EQ(truth_->num_robots, 2);
    EXPECT_EQ(truth_->robots[1].robot, "NEW");
    ASSERT_TRUE(wait_for([&] {
      bus_.publish(RobotChannels("NEW").joint_command, command(0, {"HeadYaw"}, {0.7}, {1}));
      return truth_->robots[1].joint_position[0] > 0.6;
    }));
    EXPECT_NEAR(truth_->robots[0].joint_position[0], 0, 0.05);
    naolcm::world_command_t removal{};
    removal.command = "remove-robot";
    removal.robot = "NEW";
    EXPECT_EQ(ask(removal), "");
    EXPECT_EQ(truth_->num_robots, 1);
    bus_.publish(RobotChannels("NEW").joint_command, command(0, {"HeadYaw"}, {0.7}, {1}));
    const int64_t tick = truth_->tick;
    ASSERT_TRUE(wait_for([&] { return truth_->tick > tick + 20; }));
  }
}

TEST_F(SimProgram, PublishesTeamsAndNumbers) {
  start({"--robot", "A:nao:0:7", "--robot", "B:nao:1:2"});
  ASSERT_TRUE(wait_for([&] { return truth_.has_value(); }));
  EXPECT_EQ(truth_->robots[0].team, 0);
  EXPECT_EQ(truth_->robots[0].number, 7);
  EXPECT_EQ(truth_->robots[1].team, 1);
  EXPECT_EQ(truth_->robots[1].number, 2);
}

TEST_F(SimProgram, ReportsAnInvalidCommandLine) {
  EXPECT_EQ(ChildProgram("nao-sim", {"--robot", "A", "--robot", "A"}).wait(), 1);
  EXPECT_EQ(ChildProgram("nao-sim", {"--robot", "nao 1"}).wait(), 2);

  EXPECT_NE(ChildProgram("nao-sim", {"--lcm-url", private_bus_url(), "--tick-ms", "11"}).wait(), 0);
  EXPECT_EQ(ChildProgram("nao-sim", {"--pace", "-1"}).wait(), 2);
  EXPECT_EQ(ChildProgram("nao-sim", {"--lcm-url", private_bus_url(), "--scene", "moon"}).wait(), 1);
  EXPECT_EQ(
      ChildProgram("nao-sim", {"--lcm-url", private_bus_url(), "--posture", "Headstand"}).wait(),
      1);
}

}  // namespace
}  // namespace nao::sim
