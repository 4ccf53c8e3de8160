#include "daemons/motion/robot_presence.h"

#include <gtest/gtest.h>

#include "test/daemons/motion/perfect_robot.h"

namespace nao::motion {
namespace {

using Change = RobotPresence::Change;

class RobotPresenceTest : public ::testing::Test {
 protected:
  Change take(double dt = 0.01) {
    ++sensors_.tick;
    return presence_.take(sensors_, dt);
  }

  Sensors sensors_ = PerfectRobot().sensors();
  RobotPresence presence_{nao_model(), 0.5};
};

TEST_F(RobotPresenceTest, AppearsWithTheFirstSensorData) {
  EXPECT_FALSE(presence_.has_robot());
  EXPECT_EQ(presence_.wait(10), Change::kNone);
  EXPECT_EQ(take(), Change::kAppeared);
  EXPECT_TRUE(presence_.has_robot());
  EXPECT_EQ(take(), Change::kNone);
}

TEST_F(RobotPresenceTest, IsLostOnceAfterTheTimeout) {
  take();
  EXPECT_EQ(presence_.wait(0.3), Change::kNone);
  EXPECT_EQ(presence_.wait(0.3), Change::kLost);
  EXPECT_FALSE(presence_.has_robot());
  EXPECT_EQ(presence_.wait(0.3), Change::kNone);
  EXPECT_EQ(take(), Change::kAppeared);
}

TEST_F(RobotPresenceTest, ShortGapsDoNotAddUp) {
  for (int i = 0; i < 10; ++i) {
    take();
    EXPECT_EQ(presence_.wait(0.3), Change::kNone);
  }
}

TEST_F(RobotPresenceTest, IsPlacedWhenItsTicksBeginAnew) {
  take();
  take();
  sensors_.tick = 0;
  EXPECT_EQ(presence_.take(sensors_, 0.01), Change::kPlaced);
}

TEST_F(RobotPresenceTest, IsPlacedWhenAJointJumps) {
  const int knee = nao_motor("LKneePitch");
  take();
  sensors_.position[knee] += 0.4;
  EXPECT_EQ(take(), Change::kNone);
  sensors_.position[knee] += 0.7;
  EXPECT_EQ(take(), Change::kPlaced);
  // After lost data a motor may have turned farther.
  sensors_.position[knee] -= 0.7;
  EXPECT_EQ(take(0.1), Change::kNone);
}

}  // namespace
}  // namespace nao::motion
