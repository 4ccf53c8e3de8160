#include "messages/body_condition.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace nao {
namespace {

naolcm::body_state_t body() {
  naolcm::body_state_t body{};
  body.battery_charge = 0.876;
  body.battery_current = -1;
  body.joint_names = {"HeadYaw", "LKneePitch"};
  body.joint_temperature = {38, 61.2};
  body.joint_status = {0, 0};
  return body;
}

TEST(BodyCondition, TellsBatteryHottestMotorAndWarningsInWords) {
  naolcm::body_state_t message = body();
  EXPECT_EQ(to_sentence(summarize(message)),
            "battery 88 %; hottest motor LKneePitch, 61 degrees Celsius; no warnings");
  message.battery_current = 1;
  message.warning_codes = {"battery-low", "joint-hot"};
  message.joint_status = {0, naolcm::body_state_t::JOINT_STATUS_HOT};
  EXPECT_EQ(to_sentence(summarize(message)),
            "battery 88 %, charging; hottest motor LKneePitch, 61 degrees Celsius; "
            "warning: the battery is low, a motor is hot (LKneePitch)");
}

TEST(BodyCondition, SaysWhatIsUnknown) {
  naolcm::body_state_t message{};
  message.battery_charge = std::nan("");
  EXPECT_FALSE(summarize(message).is_known());
  EXPECT_EQ(to_sentence(summarize(message)), "battery unknown; no warnings");
}

TEST(BodyCondition, IgnoresWhatIsNotMeasuredOrMissing) {
  naolcm::body_state_t message = body();
  message.battery_charge = 1.5;
  message.joint_temperature = {std::nan(""), 40, 90};
  message.joint_status = {naolcm::body_state_t::JOINT_STATUS_DEAD};
  const BodyCondition condition = summarize(message);
  EXPECT_EQ(condition.battery_charge, 1);
  EXPECT_EQ(condition.hottest_joint, "LKneePitch");
  EXPECT_THAT(condition.faulty_joints, testing::ElementsAre("HeadYaw"));
}

TEST(BodyCondition, PassesWarningsOfNewerProgramsOn) {
  EXPECT_EQ(body_warning_text("shell-open"), "shell-open");
}

}  // namespace
}  // namespace nao
