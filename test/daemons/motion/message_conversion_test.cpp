#include "daemons/motion/message_conversion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "common/error.h"
#include "messages/result_message.h"
#include "test/daemons/motion/sensor_message.h"

namespace nao::motion {
namespace {

TEST(MessageConversion, ReadsJointsByNameInAnyOrder) {
  naolcm::sensor_state_t message = sensor_message("StandInit", 7);
  std::reverse(message.joint_names.begin(), message.joint_names.end());
  std::reverse(message.joint_position.begin(), message.joint_position.end());
  const Sensors sensors = to_sensors(nao_model(), message);
  EXPECT_EQ(sensors.position, nao_model().find_posture("StandInit")->position);
  EXPECT_EQ(sensors.tick, 7);
}

TEST(MessageConversion, RefusesIncompleteAndBrokenSensorStates) {
  const auto refuses = [](auto&& spoil) {
    naolcm::sensor_state_t message = sensor_message("StandInit", 0);
    spoil(message);
    EXPECT_THROW(to_sensors(nao_model(), message), Error);
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  refuses([](auto& m) { m.joint_names[3] = "Tail"; });
  refuses([](auto& m) { m.joint_names[3] = m.joint_names[4]; });
  refuses([](auto& m) {
    m.joint_names.pop_back();
    for (auto* list : {&m.joint_position, &m.joint_velocity, &m.joint_torque,
                       &m.joint_target_position, &m.joint_stiffness}) {
      list->pop_back();
    }
  });
  refuses([](auto& m) { m.joint_torque.pop_back(); });
  refuses([](auto& m) { m.period = 0; });
  refuses([&](auto& m) { m.period = nan; });
  refuses([&](auto& m) { m.joint_position[0] = nan; });
  refuses([&](auto& m) { m.joint_velocity[0] = nan; });
  refuses([&](auto& m) { m.joint_torque[0] = nan; });
  refuses([&](auto& m) { m.joint_target_position[0] = nan; });
  refuses([](auto& m) { m.joint_stiffness[0] = 1.01; });
  refuses([&](auto& m) { m.joint_stiffness[0] = nan; });
  refuses([&](auto& m) { m.gyroscope_torso[1] = nan; });
  refuses([&](auto& m) { m.accelerometer_torso[1] = nan; });
  refuses([](auto& m) { m.orientation_torso_in_world[0] = 0; });
  refuses([](auto& m) { m.foot_sensor_names[0] = "Nose"; });
  refuses([](auto& m) { --m.num_foot_sensors; });
  refuses([&](auto& m) { m.foot_force[2] = nan; });
}

TEST(MessageConversion, ResultsCarryCodeArgumentsAndSentence) {
  const CommandResult result{
      "test", 3, CommandKind::kJointChange, ResultStatus::kRefused, {"joint-unknown", {"Tail"}}};
  const auto message = to_message(result, 5);
  EXPECT_EQ(message.utime, 5);
  EXPECT_EQ(message.reason_code, "joint-unknown");
  EXPECT_EQ(message.num_reason_arguments, 1);
  EXPECT_EQ(message.reason_arguments, std::vector<std::string>{"Tail"});
  EXPECT_EQ(message.reason, "The robot has no joint Tail.");
  MotionState state;
  state.last_refusal = result.reason;
  const auto state_message = to_message(state);
  EXPECT_EQ(state_message.last_refusal_code, "joint-unknown");
  EXPECT_EQ(state_message.num_last_refusal_arguments, 1);
  EXPECT_EQ(state_message.last_refusal_arguments, std::vector<std::string>{"Tail"});
  EXPECT_EQ(state_message.last_refusal, "The robot has no joint Tail.");
}

TEST(MessageConversion, JointCommandAnswersTheTick) {
  JointTargets targets{{0.1}, {0}, {1}};
  RobotState state;
  state.tick = 42;
  state.utime = 420000;
  const auto message = to_message(targets, state, {"HeadYaw"});
  EXPECT_EQ(message.tick, 42);
  EXPECT_EQ(message.utime, 420000);
  EXPECT_EQ(message.num_joints, 1);
  EXPECT_EQ(message.joint_position.at(0), 0.1);
}

}  // namespace
}  // namespace nao::motion
