// Inverse kinematics of legs of all kinds, against forward kinematics over random poses.

#include <gtest/gtest.h>

#include <random>

#include "common/error.h"
#include "kinematics/kinematics.h"
#include "kinematics/leg_kinematics.h"
#include "test/support/allocation_count.h"
#include "test/support/test_biped.h"

namespace nao {
namespace {

/** Random angles of a leg, a tenth of each range away from its limits, with a bent knee. */
LegAngles random_angles(const LegChain& chain, std::mt19937& random) {
  LegAngles angles{};
  for (int i = 0; i < chain.num_joints(); ++i) {
    const double margin = 0.1 * (chain.upper[i] - chain.lower[i]);
    angles[i] = std::uniform_real_distribution<double>(chain.lower[i] + margin,
                                                       chain.upper[i] - margin)(random);
  }
  return angles;
}

/** Greatest difference of two poses, m and rad. */
double difference(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  const Eigen::AngleAxisd turn(a.linear().transpose() * b.linear());
  return std::max((a.translation() - b.translation()).norm(), std::abs(turn.angle()));
}

class EveryHipOrder : public testing::TestWithParam<std::string> {};

TEST_P(EveryHipOrder, HasAClosedFormThatInvertsForwardKinematics) {
  TestBiped dimensions;
  dimensions.hip = GetParam();
  dimensions.knee_offset = 0.02;
  const RobotModel model = make_biped(dimensions);
  const LegKinematics legs(model);
  ASSERT_EQ(legs.method(), LegKinematics::Method::kAnalytic);
  std::mt19937 random(5);
  for (const Leg leg : {Leg::kLeft, Leg::kRight}) {
    const LegChain chain = LegChain::read(model, leg);
    for (int trial = 0; trial < 2000; ++trial) {
      const LegAngles wanted = random_angles(chain, random);
      const Eigen::Isometry3d sole = chain.calc_sole(wanted);
      const LegSolution solution = legs.solve(leg, sole);
      ASSERT_TRUE(solution.is_reachable);
      EXPECT_LT(difference(chain.calc_sole(solution.angles), sole), 1e-8) << "trial " << trial;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(LegSolver, EveryHipOrder,
                         testing::Values("zxy", "yxz", "xyz", "zyx", "yzx", "xzy"),
                         [](const auto& info) { return info.param; });

TEST(LegChain, AgreesWithTheModelsLinkPoses) {
  std::mt19937 random(6);
  for (int robot = 0; robot < 10; ++robot) {
    const RobotModel model = make_biped(random_biped(random));
    const LegKinematics legs(model);
    for (const Leg leg : {Leg::kLeft, Leg::kRight}) {
      const LegChain chain = LegChain::read(model, leg);
      const LegAngles angles = random_angles(chain, random);
      std::vector<double> position(model.num_motors(), 0.0);
      legs.write(leg, angles, position);
      const int sole = leg == Leg::kLeft ? model.left_sole() : model.right_sole();
      EXPECT_LT(difference(model.link_poses(position)[sole], chain.calc_sole(angles)), 1e-9);
    }
  }
}

TEST(NumericLegSolver, InvertsForwardKinematicsOfLegsWithoutAClosedForm) {
  std::mt19937 random(7);
  int num_solved = 0;
  int num_all = 0;
  for (int robot = 0; robot < 20; ++robot) {
    TestBiped dimensions = random_biped(random);
    dimensions.hip_offset = 0.05 * dimensions.thigh;
    dimensions.ankle_offset = 0.03 * dimensions.shank;
    const RobotModel model = make_biped(dimensions);
    const LegKinematics legs(model);
    ASSERT_EQ(legs.method(), LegKinematics::Method::kNumeric);
    const LegChain chain = LegChain::read(model, Leg::kLeft);
    for (int trial = 0; trial < 200; ++trial) {
      const Eigen::Isometry3d sole = chain.calc_sole(random_angles(chain, random));
      const LegSolution solution = legs.solve(Leg::kLeft, sole);
      ++num_all;
      for (size_t i = 0; i < solution.angles.size(); ++i) {
        EXPECT_GE(solution.angles[i], chain.lower[i]);
        EXPECT_LE(solution.angles[i], chain.upper[i]);
      }
      if (!solution.is_reachable) continue;
      ++num_solved;
      EXPECT_LT(difference(chain.calc_sole(solution.angles), sole), 1e-6);
    }
  }
  // Poses near the ends of several ranges at once: a descent may end in a local minimum.
  EXPECT_GE(num_solved, 0.99 * num_all);
}

TEST(NumericLegSolver, ReachesEveryPoseOfAWalk) {
  std::mt19937 random(8);
  for (int robot = 0; robot < 20; ++robot) {
    TestBiped dimensions = random_biped(random);
    dimensions.hip_offset = 0.05 * dimensions.thigh;
    const RobotModel model = make_biped(dimensions);
    const LegKinematics legs(model);
    const LegChain chain = LegChain::read(model, Leg::kRight);
    const double length = legs.reach();
    const auto uniform = [&](double bound) {
      return std::uniform_real_distribution<double>(-bound, bound)(random);
    };
    for (int trial = 0; trial < 200; ++trial) {
      Eigen::Isometry3d sole = chain.sole;
      sole.translation() +=
          length * Eigen::Vector3d(uniform(0.25), uniform(0.08), 0.15 + uniform(0.06));
      sole.linear() = (Eigen::AngleAxisd(uniform(0.3), Eigen::Vector3d::UnitZ()) *
                       Eigen::AngleAxisd(uniform(0.15), Eigen::Vector3d::UnitY()) *
                       Eigen::AngleAxisd(uniform(0.1), Eigen::Vector3d::UnitX()))
                          .toRotationMatrix();
      const LegSolution solution = legs.solve(Leg::kRight, sole);
      ASSERT_TRUE(solution.is_reachable) << "robot " << robot << " trial " << trial;
      EXPECT_LT(difference(chain.calc_sole(solution.angles), sole), 1e-6);
    }
  }
}

TEST(LegSolver, ReportsAFootOutOfReach) {
  for (const double offset : {0.0, 0.02}) {
    TestBiped dimensions;
    dimensions.hip_offset = offset;
    const RobotModel model = make_biped(dimensions);
    const LegKinematics legs(model);
    Eigen::Isometry3d sole = LegChain::read(model, Leg::kLeft).sole;
    sole.translation().z() -= 0.02;
    EXPECT_FALSE(legs.solve(Leg::kLeft, sole).is_reachable);
  }
}

TEST(LegSolver, TakesNoMemory) {
  for (const double offset : {0.0, 0.02}) {
    TestBiped dimensions;
    dimensions.hip_offset = offset;
    const RobotModel model = make_biped(dimensions);
    const LegKinematics legs(model);
    Eigen::Isometry3d sole = LegChain::read(model, Leg::kLeft).sole;
    sole.translation().z() += 0.03;
    const size_t before = allocation_count();
    const LegSolution solution = legs.solve(Leg::kLeft, sole);
    EXPECT_EQ(allocation_count(), before);
    EXPECT_TRUE(solution.is_reachable);
  }
}

TEST(LegSolver, NeedsAHipThatRolls) {
  TestBiped dimensions;
  dimensions.hip = "zy";
  EXPECT_THROW(LegKinematics{make_biped(dimensions)}, ModelError);
}

/** A leg with other than six joints. */
struct OddLeg {
  std::string name;
  std::string hip;
  std::string ankle;
  bool has_second_knee = false;
};

class EveryOddLeg : public testing::TestWithParam<OddLeg> {
 protected:
  static TestBiped dimensions() {
    TestBiped result;
    result.hip = GetParam().hip;
    result.ankle = GetParam().ankle;
    result.has_second_knee = GetParam().has_second_knee;
    return result;
  }
};

TEST_P(EveryOddLeg, KeepsThePositionAndTheAnglesThatItHasJointsFor) {
  const RobotModel model = make_biped(dimensions());
  const LegKinematics legs(model);
  ASSERT_EQ(legs.method(), LegKinematics::Method::kNumeric);
  const LegChain chain = LegChain::read(model, Leg::kLeft);
  std::mt19937 random(9);
  const auto uniform = [&](double bound) {
    return std::uniform_real_distribution<double>(-bound, bound)(random);
  };
  for (int trial = 0; trial < 500; ++trial) {
    Eigen::Isometry3d goal = chain.sole;
    goal.translation() +=
        legs.reach() * Eigen::Vector3d(uniform(0.25), uniform(0.1), 0.15 + uniform(0.05));
    const double yaw = chain.roles.hip_yaw < 0 ? 0 : uniform(0.3);
    const double pitch = chain.roles.ankle_pitch < 0 ? 0 : uniform(0.15);
    const double roll = chain.roles.ankle_roll < 0 ? 0 : uniform(0.1);
    goal.linear() = (Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) *
                     Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()) *
                     Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitX()))
                        .toRotationMatrix();
    const LegSolution solution = legs.solve(Leg::kLeft, goal);
    ASSERT_TRUE(solution.is_reachable) << "trial " << trial;
    const Eigen::Isometry3d off = goal.inverse() * chain.calc_sole(solution.angles);
    EXPECT_LT(off.translation().norm(), 2e-3 * legs.reach());
    const Eigen::Vector3d turn =
        Eigen::AngleAxisd(off.linear()).angle() * Eigen::AngleAxisd(off.linear()).axis();
    EXPECT_NEAR(chain.roles.ankle_roll < 0 ? 0 : turn.x(), 0, 3e-3);
    EXPECT_NEAR(chain.roles.ankle_pitch < 0 ? 0 : turn.y(), 0, 3e-3);
    EXPECT_NEAR(chain.roles.hip_yaw < 0 ? 0 : turn.z(), 0, 3e-3);
    // A pure function of the pose: the pose before does not matter.
    EXPECT_EQ(solution.angles, legs.solve(Leg::kLeft, goal).angles);
  }
}

TEST_P(EveryOddLeg, MovesWithoutJumpsAndTakesNoMemory) {
  const RobotModel model = make_biped(dimensions());
  const LegKinematics legs(model);
  const LegChain chain = LegChain::read(model, Leg::kRight);
  LegAngles last{};
  for (int tick = 0; tick <= 100; ++tick) {
    // A swing forward of half a leg's length in a second.
    Eigen::Isometry3d goal = chain.sole;
    goal.translation() += legs.reach() * Eigen::Vector3d(0.005 * tick - 0.25, 0.05, 0.15);
    const size_t before = allocation_count();
    const LegAngles angles = legs.solve(Leg::kRight, goal).angles;
    EXPECT_EQ(allocation_count(), before);
    for (int i = 0; tick > 0 && i < chain.num_joints(); ++i) {
      EXPECT_NEAR(angles[i], last[i], 0.03) << "joint " << i << " tick " << tick;
    }
    last = angles;
  }
}

INSTANTIATE_TEST_SUITE_P(LegSolver, EveryOddLeg,
                         testing::Values(OddLeg{"Three", "xy", ""}, OddLeg{"Four", "xy", "y"},
                                         OddLeg{"FiveWithoutRoll", "zxy", "y"},
                                         OddLeg{"FiveWithoutYaw", "xy", "yx"},
                                         OddLeg{"FiveWithoutPitch", "zxy", "x"},
                                         OddLeg{"Seven", "zxy", "yx", true},
                                         OddLeg{"Eight", "zxyx", "yx", true}),
                         [](const auto& info) { return info.param.name; });

TEST(LegSolver, FindsTheRollOfAHipWithAxesBetweenRollAndYaw) {
  TestBiped dimensions;
  dimensions.hip_tilt = 0.25 * M_PI;
  const RobotModel model = make_biped(dimensions);
  const LegRoles roles = LegKinematics(model).roles(Leg::kLeft);
  EXPECT_EQ(roles.hip_yaw, 0);
  EXPECT_EQ(roles.hip_roll, 1);
  EXPECT_EQ(roles.sign[1], 1);
}

}  // namespace
}  // namespace nao
