#include "tools/nao/body_report.h"

#include <gtest/gtest.h>

#include <cmath>

namespace nao {
namespace {

TEST(BodyReport, TellsBatteryHottestMotorAndWarningsInWords) {
  naolcm::body_state_t body{};
  body.battery_charge = 0.876;
  body.battery_current = -1;
  body.joint_names = {"HeadYaw", "LKneePitch"};
  body.joint_temperature = {38, 61.2};
  EXPECT_EQ(body_report("NAO", body),
            "NAO: battery 88 %; hottest motor LKneePitch, 61 degrees Celsius; no warnings\n");
  body.battery_current = 1;
  body.warning_codes = {"battery-low", "joint-hot"};
  EXPECT_EQ(body_report("NAO", body),
            "NAO: battery 88 %, charging; hottest motor LKneePitch, 61 degrees Celsius; "
            "warning: the battery is low, a motor is hot\n");
}

TEST(BodyReport, SaysWhatIsUnknown) {
  naolcm::body_state_t body{};
  body.battery_charge = std::nan("");
  EXPECT_EQ(body_report("NAO", body), "NAO: battery unknown; no warnings\n");
}

}  // namespace
}  // namespace nao
