#include "daemons/motion/walk/walk_observer.h"

#include <gtest/gtest.h>

#include "test/daemons/motion/walk/nao_gait.h"

namespace nao::motion {
namespace {

using Eigen::AngleAxisd;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kObserverTick = 0.01;  // s

class WalkObserverTest : public testing::Test {
 protected:
  WalkObserverTest() {
    state_.torso_in_odometry.translation() << 1, 2, 0.3;
    state_.left_sole_in_odometry.translation() << 1, 2.05, 0;
    state_.right_sole_in_odometry.translation() << 1, 1.95, 0;
    state_.left_foot_force = 30;
    state_.right_foot_force = 20;
    state_.center_of_pressure_in_odometry << 1, 2;
    reference_.start({0, -0.05}, 0.26);
  }

  void update(bool support_is_left, double torso_pitch = 0) {
    observer_.update(state_, {0, 0, -0.04}, support_is_left, reference_, torso_pitch,
                     kObserverTick);
  }

  Gait gait_ = nao_gait();
  RobotState state_;
  ComReference reference_{gait_};
  WalkObserver observer_{gait_};
};

TEST_F(WalkObserverTest, MeasuresTheCenterOfMassOverTheSupportFoot) {
  update(true);
  EXPECT_NEAR((observer_.com().position - Vector2d(0, -0.05)).norm(), 0, 1e-12);
  observer_.start();
  update(false);
  EXPECT_NEAR((observer_.com().position - Vector2d(0, 0.05)).norm(), 0, 1e-12);
}

TEST_F(WalkObserverTest, KeepsTheVelocityWhenTheSupportFootChanges) {
  // The center of mass moves at 0.2 m/s, with the pressure under it: no acceleration.
  for (int i = 0; i < 200; ++i) {
    state_.torso_in_odometry.translation().x() += 0.2 * kObserverTick;
    state_.center_of_pressure_in_odometry = state_.torso_in_odometry.translation().head<2>();
    update(true);
  }
  EXPECT_NEAR(observer_.com().velocity.x(), 0.2, 0.02);
  update(false);
  EXPECT_NEAR(observer_.com().velocity.x(), 0.2, 0.02);
}

TEST_F(WalkObserverTest, MeasuresTiltAgainstTheCommandedPitch) {
  state_.torso_in_odometry.linear() =
      (AngleAxisd(0.7, Vector3d::UnitZ()) * AngleAxisd(0.15, Vector3d::UnitY()) *
       AngleAxisd(-0.08, Vector3d::UnitX()))
          .toRotationMatrix();
  update(true, 0.05);
  EXPECT_NEAR(observer_.tilt().x(), -0.08, 1e-9);
  EXPECT_NEAR(observer_.tilt().y(), 0.1, 1e-9);
  EXPECT_NEAR(observer_.midpoint_in_odometry().heading, 0.7, 1e-9);
}

TEST_F(WalkObserverTest, SmoothsTheAngularVelocity) {
  state_.angular_velocity_torso = {1, 0, 0};
  update(true);
  EXPECT_GT(observer_.angular_velocity().x(), 0.3);
  EXPECT_LT(observer_.angular_velocity().x(), 0.9);
  for (int i = 0; i < 20; ++i) update(true);
  EXPECT_NEAR(observer_.angular_velocity().x(), 1, 1e-3);
  observer_.start();
  EXPECT_EQ(observer_.angular_velocity(), Vector3d(0, 0, 0));
}

TEST_F(WalkObserverTest, ReadsTheLoadOfTheSwingFoot) {
  update(true);
  EXPECT_EQ(observer_.swing_force(), 20);
  update(false);
  EXPECT_EQ(observer_.swing_force(), 30);
}

}  // namespace
}  // namespace nao::motion
