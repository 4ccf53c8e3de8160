#include "kinematics/kinematics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "kinematics/leg_kinematics.h"
#include "test/daemons/motion/nao_model.h"

namespace nao {
namespace {

using motion::nao_model;

std::vector<double> random_position(std::mt19937& random) {
  std::vector<double> position;
  for (int motor = 0; motor < nao_model().num_motors(); ++motor) {
    const Joint& joint = nao_model().motor_joint(motor);
    position.push_back(std::uniform_real_distribution<double>(joint.lower, joint.upper)(random));
  }
  return position;
}

TEST(Kinematics, ZeroPostureHasThePublishedMeasures) {
  Kinematics kinematics(nao_model());
  kinematics.update(std::vector<double>(nao_model().num_motors(), 0.0));
  EXPECT_NEAR(kinematics.left_sole().translation().z(), -0.33309, 1e-9);
  EXPECT_NEAR(kinematics.left_sole().translation().y(), 0.05, 1e-9);
  // Facts sheet: (0.0212, 0, -0.0356) m.
  EXPECT_NEAR(kinematics.center_of_mass().x(), 0.0212, 5e-5);
  EXPECT_NEAR(kinematics.center_of_mass().y(), 0, 1e-9);
  EXPECT_NEAR(kinematics.center_of_mass().z(), -0.0356, 5e-5);
}

TEST(Kinematics, AgreesWithTheModelsOwnLinkPoses) {
  std::mt19937 random(2);
  Kinematics kinematics(nao_model());
  for (int trial = 0; trial < 100; ++trial) {
    const auto position = random_position(random);
    kinematics.update(position);
    const auto poses = nao_model().link_poses(position);
    for (size_t link = 0; link < poses.size(); ++link) {
      EXPECT_TRUE(kinematics.link_pose(static_cast<int>(link)).isApprox(poses[link], 1e-12));
    }
  }
}

TEST(Kinematics, JacobiansAreTheDerivatives) {
  std::mt19937 random(3);
  Kinematics kinematics(nao_model());
  constexpr double kStep = 1e-6;
  const int link = nao_model().right_sole();
  const Eigen::Vector3d point_in_link(0.05, 0.01, 0);
  for (int trial = 0; trial < 20; ++trial) {
    auto position = random_position(random);
    kinematics.update(position);
    const Eigen::Vector3d point = kinematics.link_pose(link) * point_in_link;
    const Eigen::Matrix3Xd point_jacobian = kinematics.calc_point_jacobian(link, point);
    const Eigen::Matrix3Xd angular_jacobian = kinematics.calc_angular_jacobian(link);
    const Eigen::Matrix3Xd mass_jacobian = kinematics.calc_center_of_mass_jacobian();
    for (int motor = 0; motor < nao_model().num_motors(); ++motor) {
      const double angle = position[motor];
      position[motor] = angle + kStep;
      kinematics.update(position);
      const Eigen::Vector3d point_ahead = kinematics.link_pose(link) * point_in_link;
      const Eigen::Vector3d mass_ahead = kinematics.center_of_mass();
      const Eigen::Matrix3d turned_ahead = kinematics.link_pose(link).linear();
      position[motor] = angle - kStep;
      kinematics.update(position);
      const Eigen::Vector3d point_slope =
          (point_ahead - kinematics.link_pose(link) * point_in_link) / (2 * kStep);
      const Eigen::Vector3d mass_slope = (mass_ahead - kinematics.center_of_mass()) / (2 * kStep);
      const Eigen::AngleAxisd turn(turned_ahead * kinematics.link_pose(link).linear().transpose());
      position[motor] = angle;
      EXPECT_LT((point_slope - point_jacobian.col(motor)).norm(), 1e-8);
      EXPECT_LT((mass_slope - mass_jacobian.col(motor)).norm(), 1e-8);
      EXPECT_LT((turn.axis() * turn.angle() / (2 * kStep) - angular_jacobian.col(motor)).norm(),
                1e-7);
    }
  }
}

TEST(LegKinematics, InvertsForwardKinematics) {
  std::mt19937 random(4);
  Kinematics kinematics(nao_model());
  const LegKinematics legs(nao_model());
  for (int trial = 0; trial < 2000; ++trial) {
    auto position = random_position(random);
    // A knee bent backwards is the other solution of the same pose.
    for (Leg leg : {Leg::kLeft, Leg::kRight}) {
      position[legs.motors(leg)[3]] = std::abs(position[legs.motors(leg)[3]]);
    }
    kinematics.update(position);
    for (Leg leg : {Leg::kLeft, Leg::kRight}) {
      const Eigen::Isometry3d sole =
          leg == Leg::kLeft ? kinematics.left_sole() : kinematics.right_sole();
      const LegSolution free = legs.solve(leg, sole);
      const LegSolution fixed =
          legs.solve_with_hip_yaw_pitch(leg, sole, position[legs.motors(leg)[0]]);
      ASSERT_TRUE(free.is_reachable && fixed.is_reachable);
      const LegAngles wanted = legs.read(leg, position);
      // Near a stretched knee the angle is the square root of a small length: a looser tolerance.
      const double tolerance = wanted[3] < 0.02 ? 1e-6 : 1e-9;
      for (size_t i = 0; i < wanted.size(); ++i) {
        EXPECT_NEAR(free.angles[i], wanted[i], tolerance) << "angle " << i;
        EXPECT_NEAR(fixed.angles[i], wanted[i], tolerance) << "angle " << i;
      }
    }
  }
}

TEST(LegKinematics, TheCommonHipYawPitchLeavesOnlyHeadingErrors) {
  Kinematics kinematics(nao_model());
  const LegKinematics legs(nao_model());
  kinematics.update(nao_model().find_posture("StandInit")->position);
  Eigen::Isometry3d left = kinematics.left_sole();
  Eigen::Isometry3d right = kinematics.right_sole();
  left.linear() = left.linear() * Eigen::AngleAxisd(0.2, Eigen::Vector3d::UnitZ());
  left.translation() += Eigen::Vector3d(0.03, 0.01, 0.005);
  const LegsSolution both = legs.solve_both(left, right, 0.5);
  ASSERT_TRUE(both.is_reachable);
  EXPECT_EQ(both.left[0], both.right[0]);
  std::vector<double> position(nao_model().num_motors(), 0.0);
  legs.write(Leg::kLeft, both.left, position);
  legs.write(Leg::kRight, both.right, position);
  kinematics.update(position);
  EXPECT_LT((kinematics.left_sole().linear().col(2) - left.linear().col(2)).norm(), 1e-9);
  EXPECT_LT((kinematics.right_sole().linear().col(2) - right.linear().col(2)).norm(), 1e-9);
  const Eigen::Vector3d ankle(0, 0, 0.04519);
  EXPECT_LT((kinematics.left_sole() * ankle - left * ankle).norm(), 1e-9);
  EXPECT_LT((kinematics.right_sole() * ankle - right * ankle).norm(), 1e-9);
}

TEST(LegKinematics, ReportsAFootOutOfReach) {
  Kinematics kinematics(nao_model());
  const LegKinematics legs(nao_model());
  kinematics.update(nao_model().find_posture("StandZero")->position);
  Eigen::Isometry3d sole = kinematics.left_sole();
  sole.translation().z() -= 0.01;
  EXPECT_FALSE(legs.solve(Leg::kLeft, sole).is_reachable);
}

}  // namespace
}  // namespace nao
