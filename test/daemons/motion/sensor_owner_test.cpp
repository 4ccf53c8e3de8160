#include "daemons/motion/sensor_owner.h"

#include <gtest/gtest.h>

namespace nao::motion {
namespace {

TEST(SensorOwner, KeepsToTheFirstOfTwoRobots) {
  SensorOwner owner;
  for (int i = 0; i < 1000; ++i) {
    const double now = 0.01 * i;
    EXPECT_TRUE(owner.accepts(500'000'000 + 10'000 * i, now));
    EXPECT_FALSE(owner.accepts(10'000 * i, now + 0.003));
    EXPECT_FALSE(owner.accepts(900'000'000 + 10'000 * i, now + 0.006));
  }
  EXPECT_EQ(owner.num_rejected(), 2000);
}

TEST(SensorOwner, TakesAnotherWhenTheFirstIsSilent) {
  SensorOwner owner;
  EXPECT_TRUE(owner.accepts(500'000'000, 1));
  EXPECT_FALSE(owner.accepts(0, 1.01));
  EXPECT_TRUE(owner.accepts(10'000, 1.3));
  EXPECT_TRUE(owner.accepts(20'000, 1.31));
}

TEST(SensorOwner, FollowsAResetWithinTwelveStates) {
  SensorOwner owner;
  EXPECT_TRUE(owner.accepts(500'000'000, 1));
  for (int i = 0; i < 11; ++i) EXPECT_FALSE(owner.accepts(10'000 * i, 1.01 + 0.01 * i));
  EXPECT_TRUE(owner.is_contested(1.2));
  EXPECT_FALSE(owner.is_contested(1.6));
  EXPECT_TRUE(owner.accepts(110'000, 1.12));
  EXPECT_FALSE(owner.is_contested(1.12));
  EXPECT_TRUE(owner.accepts(120'000, 1.13));
}

TEST(SensorOwner, TakesRepeatedAndLostStates) {
  SensorOwner owner;
  EXPECT_TRUE(owner.accepts(10'000, 1));
  EXPECT_TRUE(owner.accepts(10'000, 1.1));
  EXPECT_TRUE(owner.accepts(1'010'000, 1.1));
}

}  // namespace
}  // namespace nao::motion
