#include "phone-gateway/server/core/component_monitor.h"

#include <gtest/gtest.h>

namespace nao::gateway {
namespace {

class ComponentMonitorTest : public testing::Test {
 protected:
  /** Advances the time; messages arrive every 20 ms. */
  void pass(double time) {
    const double end = now_ + time;
    while (now_ < end - 1e-9) {
      now_ += 0.02;
      if (motion_) monitor_.handle_motion_state(robot_, now_);
      if (motion_ && robot_) monitor_.handle_robot_state(now_);
      if (images_) monitor_.handle_image(now_);
      if (camera_) monitor_.handle_camera_status(now_);
      for (const auto& change : monitor_.step(now_)) changes_.push_back(change);
    }
  }

  /** Which messages arrive. */
  bool motion_ = true;
  bool robot_ = true;
  bool camera_ = true;
  bool images_ = false;
  double now_ = 10;
  ComponentMonitor monitor_{GatewayLimits{}};
  std::vector<ComponentMonitor::Change> changes_;
};

TEST_F(ComponentMonitorTest, ReportsEachComponentOnceWhenItBecomesAvailable) {
  pass(10);
  ASSERT_EQ(changes_.size(), 3u);
  for (const auto& change : changes_) EXPECT_TRUE(change.is_available);
}

TEST_F(ComponentMonitorTest, DetectsTheLossOfMotionWithinTwoSeconds) {
  pass(1);
  motion_ = false;
  pass(2);
  EXPECT_FALSE(monitor_.is_available(Component::kMotion));
  EXPECT_FALSE(monitor_.is_available(Component::kRobot));
  EXPECT_TRUE(monitor_.is_available(Component::kCamera));
  motion_ = true;
  pass(0.1);
  EXPECT_TRUE(monitor_.is_available(Component::kRobot));
}

TEST_F(ComponentMonitorTest, DistinguishesTheRobotFromNaoMotion) {
  pass(1);
  robot_ = false;
  pass(0.1);
  EXPECT_TRUE(monitor_.is_available(Component::kMotion));
  EXPECT_FALSE(monitor_.is_available(Component::kRobot));
}

TEST_F(ComponentMonitorTest, DetectsMissingImagesWithinTwoSeconds) {
  monitor_.set_images_requested(true, now_);
  images_ = true;
  pass(5);
  EXPECT_TRUE(monitor_.is_available(Component::kCamera));
  images_ = false;
  pass(2);
  EXPECT_FALSE(monitor_.is_available(Component::kCamera));
}

TEST_F(ComponentMonitorTest, DetectsTheLossOfAnUnusedCameraWithinTwoSeconds) {
  pass(1);
  camera_ = false;
  pass(1.5);
  EXPECT_TRUE(monitor_.is_available(Component::kCamera)) << "two of its messages may be lost";
  pass(0.5);
  EXPECT_FALSE(monitor_.is_available(Component::kCamera));
}

TEST_F(ComponentMonitorTest, ExpectsImagesOnlyIfTheyAreRequestedAndThereIsARobot) {
  pass(20);
  EXPECT_TRUE(monitor_.is_available(Component::kCamera)) << "no images are requested";
  monitor_.set_images_requested(true, now_);
  robot_ = false;
  pass(20);
  EXPECT_TRUE(monitor_.is_available(Component::kCamera)) << "there is no robot";
  robot_ = true;
  pass(0.5);
  EXPECT_TRUE(monitor_.is_available(Component::kCamera)) << "the robot has just become available";
}

}  // namespace
}  // namespace nao::gateway
