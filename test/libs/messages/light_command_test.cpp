#include "messages/light_command.h"

#include <gtest/gtest.h>

#include <cmath>

#include "messages/light_settings.h"

namespace nao {
namespace {

const LightColor kRed{1, 0, 0};
const LightColor kBlue{0, 0, 1};

std::string light_fault(const LightCommand& command) {
  const auto fault = check(command, {"left-eye", "chest"});
  return fault ? fault->code : "";
}

TEST(LightCommand, ChecksNamesColorsAndDuration) {
  EXPECT_EQ(light_fault({{"left-eye", "chest"}, {kRed, {0, 0.5, 1}}, 0}), "");
  EXPECT_EQ(light_fault({}), "lights-missing");
  EXPECT_EQ(light_fault({{"tail"}, {kRed}, 0}), "light-unknown");
  for (const double part : {-0.1, 1.1, std::nan("")}) {
    EXPECT_EQ(light_fault({{"chest"}, {{0, part, 0}}, 0}), "light-color-out-of-range");
  }
  for (const double duration : {-1.0, HUGE_VAL, std::nan("")}) {
    EXPECT_EQ(light_fault({{"chest"}, {kRed}, duration}), "light-duration-out-of-range");
  }
}

TEST(LightCommand, IsTheSameAfterItsMessage) {
  const LightCommand command{{"left-eye", "chest"}, {kRed, kBlue}, 2};
  const LightCommand read = to_light_command(to_message(command));
  EXPECT_EQ(read.light_names, command.light_names);
  EXPECT_EQ(read.light_rgb, command.light_rgb);
  EXPECT_EQ(read.duration, command.duration);
}

TEST(LightSettings, ShowAColorForItsDurationAndThenTheOneBefore) {
  LightSettings settings(2);
  EXPECT_EQ(settings.color(0), std::nullopt);
  settings.set(0, kRed, 0);
  settings.set(0, kBlue, 0.1);
  settings.step(0.05);
  EXPECT_EQ(settings.color(0), kBlue);
  settings.step(0.06);
  EXPECT_EQ(settings.color(0), kRed);
  settings.set(1, kBlue, 0.1);
  settings.step(0.2);
  EXPECT_EQ(settings.color(1), std::nullopt);
}

TEST(LightSettings, ANewLastingColorIsShownAtOnce) {
  LightSettings settings(1);
  settings.set(0, kBlue, 10);
  settings.set(0, kRed, 0);
  EXPECT_EQ(settings.color(0), kRed);
}

}  // namespace
}  // namespace nao
