#include "daemons/robot/frame_clock.h"

#include <gtest/gtest.h>

#include "common/random.h"

namespace nao::robot {
namespace {

TEST(FrameClock, JitterOfFramesIsNotOneOfRobotTime) {
  FrameClock clock(0.012, false);
  Random random(1);
  int64_t last = clock.take(100).utime;
  for (int i = 1; i < 1000; ++i) {
    const FrameClock::Stamp stamp = clock.take(100 + 0.012 * i + random.uniform(-0.003, 0.003));
    EXPECT_EQ(stamp.num_periods, 1);
    EXPECT_NEAR(static_cast<double>(stamp.utime - last), 12000, 600);
    last = stamp.utime;
  }
  EXPECT_NEAR(static_cast<double>(last), (100 + 0.012 * 999) * 1e6, 3000);
}

TEST(FrameClock, CountsLostFrames) {
  FrameClock clock(0.012, false);
  EXPECT_EQ(clock.take(5).num_periods, 0);
  EXPECT_EQ(clock.take(5.012).num_periods, 1);
  EXPECT_EQ(clock.take(5.036).num_periods, 2);
  EXPECT_EQ(clock.take(6.036).num_periods, 83);
  EXPECT_NEAR(static_cast<double>(clock.take(6.048).utime), 6.048e6, 5000);
}

TEST(FrameClock, NeverGoesBack) {
  FrameClock clock(0.012, false);
  int64_t last = 0;
  for (const double now : {1.0, 1.012, 1.5, 1.5001, 1.5002, 1.4, 1.55}) {
    const int64_t utime = clock.take(now).utime;
    EXPECT_GE(utime, last);
    last = utime;
  }
}

TEST(FrameClock, CountsFramesInLockStep) {
  FrameClock clock(0.012, true);
  EXPECT_EQ(clock.take(7).utime, 0);
  EXPECT_EQ(clock.take(700).utime, 12000);
  EXPECT_EQ(clock.take(700).utime, 24000);
}

}  // namespace
}  // namespace nao::robot
