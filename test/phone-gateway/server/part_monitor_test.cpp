#include "phone-gateway/server/part_monitor.h"

#include <gtest/gtest.h>

namespace nao {
namespace {

using Part = PartMonitor::Part;

class PartMonitorTest : public testing::Test {
 protected:
  /** Lets time go by; what speaks is heard every 20 ms. */
  void pass(double time) {
    const double end = now_ + time;
    while (now_ < end - 1e-9) {
      now_ += 0.02;
      if (motion_) monitor_.heard_motion(robot_, now_);
      if (motion_ && robot_) monitor_.heard_robot(now_);
      if (images_) monitor_.heard_image(now_);
      if (camera_) monitor_.heard_camera_status(now_);
      for (const auto& change : monitor_.step(now_)) changes_.push_back(change);
    }
  }

  bool motion_ = true;
  bool robot_ = true;
  bool camera_ = true;
  bool images_ = false;
  double now_ = 10;
  PartMonitor monitor_{GatewayLimits{}};
  std::vector<PartMonitor::Change> changes_;
};

TEST_F(PartMonitorTest, TellsEveryPartOnceWhenItComes) {
  pass(10);
  ASSERT_EQ(changes_.size(), 3u);
  for (const auto& change : changes_) EXPECT_TRUE(change.is_available);
}

TEST_F(PartMonitorTest, MissesMotionAndRobotWithinTwoSeconds) {
  pass(1);
  motion_ = false;
  pass(2);
  EXPECT_FALSE(monitor_.is_available(Part::kMotion));
  EXPECT_FALSE(monitor_.is_available(Part::kRobot));
  EXPECT_TRUE(monitor_.is_available(Part::kCamera));
  motion_ = true;
  pass(0.1);
  EXPECT_TRUE(monitor_.is_available(Part::kRobot));
}

TEST_F(PartMonitorTest, TellsARobotFromTheProgramThatMovesIt) {
  pass(1);
  robot_ = false;
  pass(0.1);
  EXPECT_TRUE(monitor_.is_available(Part::kMotion));
  EXPECT_FALSE(monitor_.is_available(Part::kRobot));
}

TEST_F(PartMonitorTest, MissesWatchedImagesWithinTwoSeconds) {
  monitor_.set_watched(true, now_);
  images_ = true;
  pass(5);
  EXPECT_TRUE(monitor_.is_available(Part::kCamera));
  images_ = false;
  pass(2);
  EXPECT_FALSE(monitor_.is_available(Part::kCamera));
}

TEST_F(PartMonitorTest, MissesACameraThatNobodyWatchesWithinTwoSeconds) {
  pass(1);
  camera_ = false;
  pass(1.5);
  EXPECT_TRUE(monitor_.is_available(Part::kCamera)) << "two of its messages may be lost";
  pass(0.5);
  EXPECT_FALSE(monitor_.is_available(Part::kCamera));
}

TEST_F(PartMonitorTest, ExpectsNoImagesOfNobodyOrNothing) {
  pass(20);
  EXPECT_TRUE(monitor_.is_available(Part::kCamera)) << "nobody watches";
  monitor_.set_watched(true, now_);
  robot_ = false;
  pass(20);
  EXPECT_TRUE(monitor_.is_available(Part::kCamera)) << "there is no robot to show";
  robot_ = true;
  pass(0.5);
  EXPECT_TRUE(monitor_.is_available(Part::kCamera)) << "the robot has just come back";
}

}  // namespace
}  // namespace nao
