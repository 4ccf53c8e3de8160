#include "common/log_clock.h"

#include <gtest/gtest.h>

#include <limits>

namespace nao {
namespace {

constexpr int64_t kSecond = 1'000'000;
constexpr int64_t kNow = 1'700'000'000 * kSecond;

TEST(LogClock, LeavesTimesWithoutStepsAsTheyAre) {
  LogClock clock;
  EXPECT_EQ(clock.take(kNow, "A", 0), kNow);
  EXPECT_EQ(clock.take(kNow + kSecond, "B", 0), kNow + kSecond);
  // Nothing happens for half an hour, in a recording of commands.
  EXPECT_EQ(clock.take(kNow + 1800 * kSecond, "A", 0), kNow + 1800 * kSecond);
  EXPECT_EQ(clock.num_steps(), 0);
}

TEST(LogClock, BridgesStepsWithoutARobotByNoTime) {
  LogClock clock;
  clock.take(kNow, "A", 0);
  EXPECT_EQ(clock.take(kSecond, "A", 0), kNow);
  EXPECT_EQ(clock.take(kNow + kSecond, "A", 0), kNow);
  EXPECT_EQ(clock.take(kNow + 2 * kSecond, "A", 0), kNow + kSecond);
  EXPECT_EQ(clock.num_steps(), 2);
  EXPECT_NEAR(clock.longest_step(), 1.7e9, 2);
}

TEST(LogClock, FindsAStepOfAMinuteByTheRobotsTime) {
  LogClock clock;
  clock.take(kNow, "STATE", kSecond);
  clock.take(kNow + kSecond / 2, "OTHER", 0);
  EXPECT_EQ(clock.take(kNow + 61 * kSecond, "STATE", 2 * kSecond), kNow + kSecond);
  EXPECT_EQ(clock.num_steps(), 1);
  // The next message a minute later, by both clocks.
  EXPECT_EQ(clock.take(kNow + 121 * kSecond, "STATE", 62 * kSecond), kNow + 61 * kSecond);
  EXPECT_EQ(clock.num_steps(), 1);
}

TEST(LogClock, StandsAnyTime) {
  LogClock clock;
  int64_t last = clock.take(std::numeric_limits<int64_t>::max(), "A", 1);
  for (const int64_t wild : {kNow, std::numeric_limits<int64_t>::min(), int64_t{0},
                             std::numeric_limits<int64_t>::max(), int64_t{-1}, kNow}) {
    const int64_t time = clock.take(wild, "A", wild);
    EXPECT_GE(time, last);
    last = time;
  }
}

}  // namespace
}  // namespace nao
