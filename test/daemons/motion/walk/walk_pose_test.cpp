#include "daemons/motion/walk/walk_pose.h"

#include <gtest/gtest.h>

#include "test/daemons/motion/walk/nao_gait.h"

namespace nao::motion {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

class WalkPoseTest : public testing::Test {
 protected:
  WalkPoseTest() {
    pose_.start(position_);
    feet_.start(pose_.start_right_sole());
    reference_.start(feet_.midpoint(), pose_.start_com_height());
  }

  /** Solves until the filtered center of mass has settled. */
  void settle(double lowered) {
    for (int i = 0; i < 300; ++i) {
      pose_.solve(reference_, feet_, feet_.swing_sole({}), lowered, position_);
      pose_.update_com(position_, 0.01);
    }
  }
  Isometry3d torso() const { return pose_.torso_in_support(reference_, feet_, 1); }

  std::vector<double> position_ = nao_model().find_posture("StandInit")->position;
  WalkPose pose_{nao_model(), nao_gait()};
  Feet feet_{nao_gait()};
  ComReference reference_{nao_gait()};
};

TEST_F(WalkPoseTest, PutsTheCenterOfMassOverItsReference) {
  for (const Vector2d& com : {Vector2d(0.01, -0.05), Vector2d(0.03, -0.02), Vector2d(0, -0.08)}) {
    reference_.rest_at(com);
    settle(1);
    const Vector3d actual = torso() * pose_.kinematics().center_of_mass();
    EXPECT_NEAR((actual.head<2>() - com).norm(), 0, 1e-6) << com.transpose();
  }
}

TEST_F(WalkPoseTest, PutsTheFeetWhereTheyAreCommanded) {
  feet_.swing().step({{0.04, -0.12}, 0}, 0, 0.5, 0.02, 0.01);
  settle(1);
  const auto expect_sole = [&](const Isometry3d& sole_in_torso, const Isometry3d& expected) {
    const Isometry3d actual = torso() * sole_in_torso;
    EXPECT_NEAR((actual.translation() - expected.translation()).norm(), 0, 1e-3);
    // The feet share one motor for their headings; the soles' normals are exact.
    EXPECT_NEAR((actual.linear().col(2) - expected.linear().col(2)).norm(), 0, 1e-6);
  };
  expect_sole(pose_.kinematics().left_sole(), feet_.support_sole());
  expect_sole(pose_.kinematics().right_sole(), feet_.swing_sole({}));
  EXPECT_NEAR((torso() * pose_.kinematics().right_sole()).translation().z(), 0.02, 1e-3);
}

TEST_F(WalkPoseTest, KeepsTheHipsAtTheirHeightAndTheTorsoAtItsPitch) {
  settle(1);
  const Vector3d hips = 0.5 * (pose_.legs().hip(Leg::kLeft) + pose_.legs().hip(Leg::kRight));
  EXPECT_NEAR((torso() * hips).z(), nao_gait().stance.hip_height, 1e-9);
  EXPECT_NEAR(pose_.torso_pitch(), nao_gait().stance.torso_pitch, 1e-12);
  // By the joints, seen from the support sole.
  const Isometry3d by_joints = pose_.kinematics().left_sole().inverse();
  EXPECT_NEAR((by_joints * hips).z(), nao_gait().stance.hip_height, 1e-6);
  EXPECT_NEAR(std::acos(by_joints.linear()(2, 2)), nao_gait().stance.torso_pitch, 1e-6);
}

TEST_F(WalkPoseTest, MovesFromThePoseOfTheStartToTheWalks) {
  const std::vector<double> start = position_;
  pose_.solve(reference_, feet_, feet_.swing_sole({}), 0, position_);
  for (int motor = 0; motor < nao_model().num_motors(); ++motor) {
    EXPECT_NEAR(position_[motor], start[motor], 1e-3) << nao_model().motor_joint(motor).name;
  }
  const double high = (pose_.torso_in_support(reference_, feet_, 0)).translation().z();
  const double low = (pose_.torso_in_support(reference_, feet_, 1)).translation().z();
  EXPECT_NEAR(pose_.torso_in_support(reference_, feet_, 0.5).translation().z(), (high + low) / 2,
              1e-9);
  EXPECT_GE(pose_.lowering_duration(), 0.3);
}

TEST_F(WalkPoseTest, SwingsTheArmsAgainstTheStride) {
  feet_.swing().step({{0.05, -0.1}, 0}, 0, 1, 0, 0.01);
  pose_.solve(reference_, feet_, feet_.swing_sole({}), 1, position_);
  // The right foot is ahead: the right arm goes back, the left one forward (smaller pitch).
  const int left = nao_model().find_motor("LShoulderPitch");
  const int right = nao_model().find_motor("RShoulderPitch");
  for (const WalkingArmJoint& joint : nao_model().references().walking_arms) {
    if (joint.motor == left) {
      EXPECT_LT(position_[left], joint.angle);
    }
    if (joint.motor == right) {
      EXPECT_GT(position_[right], joint.angle);
    }
  }
}

}  // namespace
}  // namespace nao::motion
