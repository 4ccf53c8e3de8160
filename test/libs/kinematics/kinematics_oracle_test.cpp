// Kinematics against Simbody's, which other code builds from the same URDF.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "kinematics/kinematics.h"
#include "kinematics/leg_kinematics.h"
#include "sim/simbody_model.h"
#include "test/daemons/motion/nao_model.h"

namespace nao {
namespace {

using motion::nao_model;

constexpr double kTolerance = 1e-9;  // m, m/rad and of a rotation's entries

Eigen::Vector3d to_eigen(const SimTK::Vec3& vector) {
  return {vector[0], vector[1], vector[2]};
}

/** Random joint angles in both descriptions, torso at the world's origin, hands closed (Simbody's
 * model carries the fingers, which have no mass, as they are then). */
class KinematicsOracleTest : public testing::Test {
 protected:
  KinematicsOracleTest()
      : simbody_(nao_model()), tree_(simbody_), simbody_state_(simbody_.default_state()) {}

  /** @param velocity  rad/s, (num_motors). */
  void realize(const std::vector<double>& position, const std::vector<double>& velocity) {
    sim::TreeState state(tree_.num_dofs());
    for (int dof = 6; dof < tree_.num_dofs(); ++dof) {
      const int joint = tree_.bodies()[tree_.body_of_dof(dof)].joint;
      const int motor = nao_model().find_motor(nao_model().joints()[joint].name);
      state.coordinate[dof] = position[motor];
      state.velocity[dof] = velocity[motor];
    }
    simbody_.set_state(tree_, state, simbody_state_);
    simbody_.system().realize(simbody_state_, SimTK::Stage::Velocity);
    kinematics_.update(position);
  }

  std::vector<double> random_position() {
    std::vector<double> position;
    for (int motor = 0; motor < nao_model().num_motors(); ++motor) {
      const Joint& joint = nao_model().motor_joint(motor);
      const bool is_hand = joint.name == "LHand" || joint.name == "RHand";
      position.push_back(is_hand ? 0.0 : draw(joint.lower, joint.upper));
    }
    return position;
  }

  double draw(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }

  Eigen::Isometry3d pose_of(int link) const {
    const SimTK::Transform& body =
        simbody_.mobilized(simbody_.body_of_link(link)).getBodyTransform(simbody_state_);
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    for (int row = 0; row < 3; ++row) {
      pose.translation()[row] = body.p()[row];
      for (int column = 0; column < 3; ++column) {
        pose.linear()(row, column) = body.R()[row][column];
      }
    }
    return pose * simbody_.pose_in_body(link);
  }

  std::mt19937_64 random_{1};
  sim::SimbodyModel simbody_;
  sim::Tree tree_;
  SimTK::State simbody_state_;
  Kinematics kinematics_{nao_model()};
};

TEST_F(KinematicsOracleTest, LinksAndCenterOfMassAreWhereSimbodyHasThem) {
  const std::vector<double> rest(nao_model().num_motors(), 0.0);
  for (int trial = 0; trial < 100; ++trial) {
    realize(random_position(), rest);
    for (int link = 0; link < static_cast<int>(nao_model().links().size()); ++link) {
      const double error =
          (kinematics_.link_pose(link).matrix() - pose_of(link).matrix()).cwiseAbs().maxCoeff();
      EXPECT_LT(error, kTolerance) << nao_model().links()[link].name;
    }
    const Eigen::Vector3d mass =
        to_eigen(simbody_.matter().calcSystemMassCenterLocationInGround(simbody_state_));
    EXPECT_LT((kinematics_.center_of_mass() - mass).norm(), kTolerance);
  }
}

TEST_F(KinematicsOracleTest, JacobiansGiveSimbodysVelocities) {
  const int sole = nao_model().right_sole();
  for (int trial = 0; trial < 100; ++trial) {
    std::vector<double> velocity;
    for (int motor = 0; motor < nao_model().num_motors(); ++motor) {
      velocity.push_back(draw(-1, 1));
    }
    for (const char* hand : {"LHand", "RHand"}) velocity[nao_model().find_motor(hand)] = 0;
    realize(random_position(), velocity);
    const Eigen::Map<const Eigen::VectorXd> rates(velocity.data(),
                                                  static_cast<long>(velocity.size()));
    const SimTK::MobilizedBody& body = simbody_.mobilized(simbody_.body_of_link(sole));
    const Eigen::Vector3d in_body = simbody_.pose_in_body(sole).translation();
    const SimTK::Vec3 station(in_body.x(), in_body.y(), in_body.z());
    const Eigen::Vector3d point = kinematics_.link_pose(sole).translation();
    EXPECT_LT((kinematics_.calc_point_jacobian(sole, point) * rates -
               to_eigen(body.findStationVelocityInGround(simbody_state_, station)))
                  .norm(),
              kTolerance);
    EXPECT_LT((kinematics_.calc_angular_jacobian(sole) * rates -
               to_eigen(body.getBodyAngularVelocity(simbody_state_)))
                  .norm(),
              kTolerance);
    const Eigen::Vector3d mass =
        to_eigen(simbody_.matter().calcSystemMassCenterVelocityInGround(simbody_state_));
    EXPECT_LT((kinematics_.calc_center_of_mass_jacobian() * rates - mass).norm(), kTolerance);
  }
}

TEST_F(KinematicsOracleTest, LegAnglesPutTheSolesWhereSimbodyHasThem) {
  const std::vector<double> rest(nao_model().num_motors(), 0.0);
  const LegKinematics legs(nao_model());
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<double> position = random_position();
    // A knee bent backwards is the other solution of the same pose, a stretched one has none near.
    for (Leg leg : {Leg::kLeft, Leg::kRight}) {
      double& knee = position[legs.motors(leg)[3]];
      knee = std::max(0.1, std::abs(knee));
    }
    realize(position, rest);
    for (Leg leg : {Leg::kLeft, Leg::kRight}) {
      const int sole = leg == Leg::kLeft ? nao_model().left_sole() : nao_model().right_sole();
      const LegSolution solution = legs.solve(leg, pose_of(sole));
      ASSERT_TRUE(solution.is_reachable);
      const LegAngles wanted = legs.read(leg, position);
      for (size_t i = 0; i < wanted.size(); ++i) {
        EXPECT_NEAR(solution.angles[i], wanted[i], kTolerance) << "angle " << i;
      }
    }
  }
}

}  // namespace
}  // namespace nao
