#include "daemons/motion/motion_daemon.h"

#include <gtest/gtest.h>

#include <naolcm/command_result_t.hpp>
#include <naolcm/daemon_status_t.hpp>
#include <naolcm/joint_command_t.hpp>
#include <naolcm/posture_command_t.hpp>
#include <naolcm/robot_state_t.hpp>
#include <naolcm/stop_command_t.hpp>
#include <naolcm/walk_command_t.hpp>
#include <utility>

#include "test/daemons/motion/sensor_message.h"

namespace nao::motion {
namespace {

class MotionDaemonTest : public ::testing::Test {
 protected:
  MotionDaemonTest() {
    bus_.subscribe<naolcm::joint_command_t>("NAO_JOINT_COMMAND", Bus::Queue::kAll,
                                            [this](const auto& m) { commands_.push_back(m); });
    bus_.subscribe<naolcm::robot_state_t>("NAO_ROBOT_STATE", Bus::Queue::kAll,
                                          [this](const auto& m) { states_.push_back(m); });
    bus_.subscribe<naolcm::command_result_t>("NAO_COMMAND_RESULT", Bus::Queue::kAll,
                                             [this](const auto& m) { results_.push_back(m); });
  }

  void tick() {
    bus_.publish("NAO_SENSOR_STATE", sensor_message("StandInit", next_tick_++, period_));
    while (bus_.handle_for(0)) {
    }
  }

  Bus bus_{"memq://"};
  EventLoop loop_;
  MotionDaemon daemon_{bus_, loop_, nao_model(), MotionOptions(), "NAO"};
  int64_t next_tick_ = 0;
  double period_ = 0.01;
  std::vector<naolcm::joint_command_t> commands_;
  std::vector<naolcm::robot_state_t> states_;
  std::vector<naolcm::command_result_t> results_;
};

TEST_F(MotionDaemonTest, AnswersEverySensorStateWithItsTick) {
  for (int i = 0; i < 5; ++i) tick();
  ASSERT_EQ(commands_.size(), 5u);
  ASSERT_EQ(states_.size(), 5u);
  for (int i = 0; i < 5; ++i) {
    EXPECT_EQ(commands_[i].tick, i);
    EXPECT_EQ(commands_[i].num_joints, nao_model().num_motors());
    EXPECT_EQ(states_[i].utime, i * 10000);
  }
}

TEST_F(MotionDaemonTest, EndsIfAnotherOneRunsForTheSameRobot) {
  naolcm::daemon_status_t status{};
  status.program = "nao-motion";
  status.robot = "Other";
  status.host = "pc";
  status.wall_utime = wall_utime();
  status.num_messages_out = 1000;
  bus_.publish("DAEMON_STATUS", status);
  tick();
  EXPECT_EQ(commands_.size(), 1u);
  status.robot = "NAO";
  bus_.publish("DAEMON_STATUS", status);
  EXPECT_THROW(tick(), Error);
  EXPECT_EQ(commands_.size(), 1u);
}

TEST_F(MotionDaemonTest, AnswersARepeatedStateAgainWithoutAnotherStep) {
  for (int i = 0; i < 3; ++i) tick();
  next_tick_ = 2;
  tick();
  ASSERT_EQ(commands_.size(), 4u);
  EXPECT_EQ(commands_[3].tick, 2);
  EXPECT_EQ(commands_[3].joint_position, commands_[2].joint_position);
  EXPECT_EQ(daemon_.num_steps(), 3);
  EXPECT_EQ(states_.size(), 3u);
}

TEST_F(MotionDaemonTest, ACommandAnswersTheLastStateOfARobotAtRestAgain) {
  for (int i = 0; i < 20; ++i) tick();
  for (int i = 0; i < 3; ++i) {
    next_tick_ += 9;
    tick();
  }
  EXPECT_EQ(commands_.size(), 23u);
  naolcm::stop_command_t command{};
  command.source = "test";
  command.command_id = 1;
  bus_.publish("NAO_STOP_COMMAND", command);
  bus_.handle();
  ASSERT_EQ(commands_.size(), 24u);
  EXPECT_EQ(commands_[23].tick, commands_[22].tick);
  EXPECT_TRUE(results_.empty());
  tick();
  EXPECT_FALSE(results_.empty());
}

TEST_F(MotionDaemonTest, PublishesResultsOfCommands) {
  for (int i = 0; i < 20; ++i) tick();
  naolcm::posture_command_t command{};
  command.source = "test";
  command.command_id = 1;
  command.posture = "Nirvana";
  command.speed = 0.5;
  bus_.publish("NAO_POSTURE_COMMAND", command);
  tick();
  tick();
  ASSERT_EQ(results_.size(), 1u);
  EXPECT_EQ(results_[0].status, naolcm::command_result_t::STATUS_REFUSED);
  EXPECT_EQ(results_[0].command_kind, naolcm::command_result_t::COMMAND_KIND_POSTURE);
  EXPECT_EQ(results_[0].reason_code, "posture-unknown");
  EXPECT_EQ(results_[0].num_reason_arguments, 2);
  EXPECT_EQ(results_[0].reason_arguments.at(0), "\"Nirvana\"");
  EXPECT_NE(results_[0].reason.find("\"Nirvana\""), std::string::npos);
  EXPECT_EQ(results_[0].command_id, 1);
}

TEST_F(MotionDaemonTest, PublishesTheFinalResultThreeTimes) {
  for (int i = 0; i < 20; ++i) tick();
  naolcm::stop_command_t command{};
  command.source = "test";
  command.command_id = 1;
  bus_.publish("NAO_STOP_COMMAND", command);
  std::vector<int64_t> done_at;
  size_t num_accepted = 0;
  for (int i = 0; i < 200; ++i) {
    tick();
    for (const auto& result : std::exchange(results_, {})) {
      if (result.status == result.STATUS_ACCEPTED) {
        ++num_accepted;
      } else {
        EXPECT_EQ(result.status, result.STATUS_DONE);
        EXPECT_EQ(result.command_id, 1);
        done_at.push_back(next_tick_);
      }
    }
  }
  EXPECT_EQ(num_accepted, 1u);
  ASSERT_EQ(done_at.size(), 3u);
  EXPECT_NEAR(static_cast<double>(done_at[1] - done_at[0]), 10, 1);
  EXPECT_NEAR(static_cast<double>(done_at[2] - done_at[0]), 50, 1);
}

TEST_F(MotionDaemonTest, StepsWithTheControlPeriodOfTheSensorStates) {
  // A final result is repeated 0.1 and 0.5 s after the first one, in robot time.
  period_ = 0.012;
  for (int i = 0; i < 20; ++i) tick();
  naolcm::stop_command_t command{};
  command.source = "test";
  command.command_id = 1;
  bus_.publish("NAO_STOP_COMMAND", command);
  std::vector<int64_t> done_utimes;
  for (int i = 0; i < 200; ++i) {
    tick();
    for (const auto& result : std::exchange(results_, {})) {
      if (result.status == result.STATUS_DONE) done_utimes.push_back(result.utime);
    }
  }
  ASSERT_EQ(done_utimes.size(), 3u);
  EXPECT_NEAR(static_cast<double>(done_utimes[1] - done_utimes[0]) * 1e-6, 0.1, 0.012);
  EXPECT_NEAR(static_cast<double>(done_utimes[2] - done_utimes[0]) * 1e-6, 0.5, 0.012);
}

TEST_F(MotionDaemonTest, LogsARepeatedWalkOnce) {
  for (int i = 0; i < 20; ++i) tick();
  naolcm::walk_command_t command{};
  command.source = "test";
  command.command_id = 1;
  command.vx = 0.1;
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  for (int i = 0; i < 10; ++i) {
    bus_.publish("NAO_WALK_COMMAND", command);
    tick();
  }
  const std::string log =
      testing::internal::GetCapturedStdout() + testing::internal::GetCapturedStderr();
  EXPECT_GT(results_.size(), 1u);
  const size_t first = log.find("walk 1 of \"test\"");
  ASSERT_NE(first, std::string::npos) << log;
  EXPECT_EQ(log.find("walk 1 of \"test\"", first + 1), std::string::npos) << log;
}

TEST_F(MotionDaemonTest, DropsABrokenSensorState) {
  tick();
  naolcm::sensor_state_t broken = sensor_message("StandInit", 100);
  broken.joint_names[0] = "Tail";
  bus_.publish("NAO_SENSOR_STATE", broken);
  while (bus_.handle_for(0)) {
  }
  EXPECT_EQ(commands_.size(), 1u);
  EXPECT_EQ(bus_.counters().num_dropped, 1);
}

}  // namespace
}  // namespace nao::motion
