// The dynamics of the physics, compared with Simbody's for the same robot.

#include "sim/tree_dynamics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "common/constants.h"
#include "sim/simbody_model.h"
#include "test/sim/sim_fixture.h"
#include "test/support/test_biped.h"

namespace nao::sim {
namespace {

/** A robot in a random state, in both representations. */
class TreeDynamicsTest : public testing::Test {
 protected:
  explicit TreeDynamicsTest(const RobotModel& model = *nao_model())
      : simbody_(model),
        tree_(simbody_),
        dynamics_(tree_),
        state_(tree_.num_dofs()),
        simbody_state_(simbody_.default_state()) {}

  void randomize() {
    const auto draw = [this](double limit) {
      return std::uniform_real_distribution<double>(-limit, limit)(random_);
    };
    state_.position = {draw(5), draw(5), draw(2)};
    state_.orientation = Eigen::Quaterniond(draw(1), draw(1), draw(1), draw(1)).normalized();
    for (int i = 0; i < tree_.num_dofs(); ++i) {
      state_.velocity[i] = draw(5);
      if (i >= 6) state_.coordinate[i] = draw(1.5);
    }
    simbody_.set_state(tree_, state_, simbody_state_);
    simbody_.system().realize(simbody_state_, SimTK::Stage::Velocity);
    dynamics_.update_kinematics(state_);
  }

  /** Simbody's forces of gravity on all bodies. */
  SimTK::Vector_<SimTK::SpatialVec> gravity() const {
    const SimTK::SimbodyMatterSubsystem& matter = simbody_.matter();
    SimTK::Vector_<SimTK::SpatialVec> forces(matter.getNumBodies(), SimTK::SpatialVec(0));
    for (int i = 0; i < tree_.num_bodies(); ++i) {
      const SimTK::MobilizedBody& body = simbody_.mobilized(i);
      const SimTK::MassProperties& mass = body.getBodyMassProperties(simbody_state_);
      matter.addInStationForce(simbody_state_, body, mass.getMassCenter(),
                               SimTK::Vec3(0, 0, -kGravity * mass.getMass()), forces);
    }
    return forces;
  }

  void expect_simbodys_accelerations();
  void expect_rows_of_the_inverse_factor();

  SimbodyModel simbody_;
  Tree tree_;
  TreeDynamics dynamics_;
  TreeState state_;
  SimTK::State simbody_state_;
  std::mt19937_64 random_{1};
};

TEST_F(TreeDynamicsTest, HasOneDofForEachMotorThatMovesABody) {
  // 25 motors, of which the two hands are openings; one dof for both hip yaw-pitch joints.
  EXPECT_EQ(tree_.num_dofs(), 6 + 23);
  EXPECT_EQ(tree_.num_bodies(), 25);
  EXPECT_NEAR(tree_.total_mass(), 5.30535, 1e-5);
}

TEST_F(TreeDynamicsTest, PlacesEveryBodyWhereSimbodyDoes) {
  for (int trial = 0; trial < 50; ++trial) {
    randomize();
    for (int i = 0; i < tree_.num_bodies(); ++i) {
      const SimTK::Transform& expected = simbody_.mobilized(i).getBodyTransform(simbody_state_);
      const SimTK::SpatialVec& velocity = simbody_.mobilized(i).getBodyVelocity(simbody_state_);
      const Eigen::Vector3d speed = dynamics_.velocity_at(i, dynamics_.position(i));
      for (int k = 0; k < 3; ++k) {
        EXPECT_NEAR(dynamics_.position(i)[k], expected.p()[k], 1e-12);
        EXPECT_NEAR(speed[k], velocity[1][k], 1e-11);
        for (int j = 0; j < 3; ++j) {
          EXPECT_NEAR(dynamics_.rotation(i)(k, j), expected.R().asMat33()(k, j), 1e-12);
        }
      }
    }
  }
}

TEST_F(TreeDynamicsTest, AcceleratesAsSimbodysOrderNAlgorithmDoes) {
  expect_simbodys_accelerations();
}

const RobotModel& coupled_model() {
  static const RobotModel model = make_coupled_biped();
  return model;
}

/** Joints that follow others on other bodies. */
class CoupledTreeTest : public TreeDynamicsTest {
 protected:
  CoupledTreeTest() : TreeDynamicsTest(coupled_model()) {}
};

TEST_F(CoupledTreeTest, AcceleratesAsSimbodysConstraintsDemand) {
  EXPECT_EQ(tree_.num_dofs(), 6 + tree_.num_bodies() - 1 - 3);
  expect_simbodys_accelerations();
}

TEST_F(CoupledTreeTest, RowsOfTheInverseSolveForUnitImpulses) {
  expect_rows_of_the_inverse_factor();
}

void TreeDynamicsTest::expect_simbodys_accelerations() {
  double worst = 0;
  Eigen::VectorXd bias = Eigen::VectorXd::Zero(tree_.num_dofs());
  for (int trial = 0; trial < 200; ++trial) {
    randomize();
    // Torques on the joints, up to the peak torque of the motors.
    Eigen::VectorXd torque = Eigen::VectorXd::Zero(tree_.num_dofs());
    for (int i = 6; i < tree_.num_dofs(); ++i) {
      torque[i] = std::uniform_real_distribution<double>(-5, 5)(random_);
    }
    dynamics_.update_mass_matrix();
    dynamics_.calc_bias({0, 0, -kGravity}, bias);
    dynamics_.factorize(Eigen::VectorXd::Zero(tree_.num_dofs()));
    Eigen::VectorXd acceleration = torque - bias;
    dynamics_.solve_upper(acceleration);
    dynamics_.solve_lower(acceleration);

    const SimTK::SimbodyMatterSubsystem& matter = simbody_.matter();
    SimTK::Vector mobility(simbody_state_.getNU(), 0.0);
    for (int i = 0; i < tree_.num_bodies(); ++i) {
      const bool is_leader = i > 0 && tree_.body_of_dof(tree_.bodies()[i].dof) == i;
      if (is_leader) {
        matter.addInMobilityForce(simbody_state_, simbody_.bodies()[i].mobilized,
                                  SimTK::MobilizerUIndex(0), torque[tree_.bodies()[i].dof],
                                  mobility);
      }
    }
    SimTK::Vector expected;
    SimTK::Vector_<SimTK::SpatialVec> body_accelerations;
    simbody_.system().realize(simbody_state_, SimTK::Stage::Dynamics);
    matter.calcAcceleration(simbody_state_, mobility, gravity(), expected, body_accelerations);

    double greatest = 0;
    double difference = 0;
    for (int i = 0; i < tree_.num_bodies(); ++i) {
      const TreeBody& body = tree_.bodies()[i];
      const auto first = simbody_.mobilized(i).getFirstUIndex(simbody_state_);
      const int count = i == 0 ? 6 : 1;
      for (int k = 0; k < count; ++k) {
        const double value = expected[int(first) + k];
        const double ours = (i == 0 ? 1 : body.ratio) * acceleration[body.dof + k];
        greatest = std::max(greatest, std::abs(value));
        difference = std::max(difference, std::abs(ours - value));
      }
    }
    worst = std::max(worst, difference / greatest);
  }
  EXPECT_LT(worst, 1e-8);
  RecordProperty("worst_relative_difference", std::to_string(worst));
}

TEST_F(TreeDynamicsTest, HasSimbodysMomentumAndEnergy) {
  for (int trial = 0; trial < 20; ++trial) {
    randomize();
    const SimTK::SimbodyMatterSubsystem& matter = simbody_.matter();
    const SimTK::SpatialVec momentum = matter.calcSystemCentralMomentum(simbody_state_);
    const SimTK::Vec3 center = matter.calcSystemMassCenterLocationInGround(simbody_state_);
    for (int k = 0; k < 3; ++k) {
      EXPECT_NEAR(dynamics_.angular_momentum()[k], momentum[0][k], 1e-10);
      EXPECT_NEAR(dynamics_.linear_momentum()[k], momentum[1][k], 1e-10);
      EXPECT_NEAR(dynamics_.center_of_mass()[k], center[k], 1e-11);
    }
    EXPECT_NEAR(dynamics_.kinetic_energy(), matter.calcKineticEnergy(simbody_state_), 1e-9);
  }
}

TEST_F(TreeDynamicsTest, HasSimbodysMassMatrixAndBiasForces) {
  const int num_dofs = tree_.num_dofs();
  Eigen::VectorXd bias = Eigen::VectorXd::Zero(num_dofs);
  for (int trial = 0; trial < 20; ++trial) {
    randomize();
    dynamics_.update_mass_matrix();
    dynamics_.calc_bias({0, 0, -kGravity}, bias);
    const SimTK::SimbodyMatterSubsystem& matter = simbody_.matter();
    const int num_u = simbody_state_.getNU();
    SimTK::Matrix mass;
    matter.calcM(simbody_state_, mass);
    // Coriolis and centrifugal forces less those of gravity.
    SimTK::Vector residual;
    matter.calcResidualForceIgnoringConstraints(simbody_state_, SimTK::Vector(num_u, 0.0),
                                                gravity(), SimTK::Vector(num_u, 0.0), residual);
    // Simbody's speeds are T times ours: two of them for the dof of coupled joints.
    Eigen::MatrixXd to_u = Eigen::MatrixXd::Zero(num_u, num_dofs);
    for (int i = 0; i < tree_.num_bodies(); ++i) {
      const int first = simbody_.mobilized(i).getFirstUIndex(simbody_state_);
      const TreeBody& body = tree_.bodies()[i];
      for (int k = 0; k < (i == 0 ? 6 : 1); ++k) to_u(first + k, body.dof + k) = body.ratio;
    }
    Eigen::MatrixXd full(num_u, num_u);
    Eigen::VectorXd force(num_u);
    for (int i = 0; i < num_u; ++i) {
      force[i] = residual[i];
      for (int k = 0; k < num_u; ++k) full(i, k) = mass(i, k);
    }
    const Eigen::MatrixXd expected = to_u.transpose() * full * to_u;
    const Eigen::VectorXd expected_bias = to_u.transpose() * force;
    for (int i = 0; i < num_dofs; ++i) {
      EXPECT_NEAR(bias[i], expected_bias[i], 1e-9) << i;
      for (int k = 0; k < num_dofs; ++k) {
        EXPECT_NEAR(dynamics_.mass_matrix(i, k), expected(i, k), 1e-11) << i << ' ' << k;
      }
    }
  }
}

/** The rows of L^-1 that constraints use. */
TEST_F(TreeDynamicsTest, RowsOfTheInverseSolveForUnitImpulses) {
  expect_rows_of_the_inverse_factor();
}

void TreeDynamicsTest::expect_rows_of_the_inverse_factor() {
  randomize();
  dynamics_.update_mass_matrix();
  dynamics_.factorize(Eigen::VectorXd::Constant(tree_.num_dofs(), 0.01));
  const auto expect_row = [&](const EntryPair* row, const std::vector<int>& dofs,
                              Eigen::VectorXd expected) {
    dynamics_.solve_upper(expected);
    for (size_t i = 0; i < dofs.size(); ++i) {
      EXPECT_NEAR(row[i / 2][static_cast<long>(i % 2)], expected[dofs[i]], 1e-10);
      expected[dofs[i]] = 0;
    }
    // Nothing outside the chain, and 0 as the partner of a last odd entry.
    EXPECT_EQ(expected.cwiseAbs().maxCoeff(), 0);
    if (dofs.size() % 2 == 1) {
      EXPECT_EQ(row[dofs.size() / 2][1], 0);
    }
  };
  for (int dof = 0; dof < tree_.num_dofs(); ++dof) {
    std::vector<int> dofs = tree_.dof_ancestors(dof);
    dofs.push_back(dof);
    Eigen::VectorXd unit = Eigen::VectorXd::Unit(tree_.num_dofs(), dof);
    expect_row(dynamics_.inverse_row(dof), dofs, unit);
    dynamics_.solve_upper(unit);
    dynamics_.solve_lower(unit);
    EXPECT_NEAR(dynamics_.inverse_square(dof), unit[dof], 1e-10 * unit[dof]);
  }
  for (int body = 0; body < tree_.num_bodies(); ++body) {
    const std::vector<int>& chain = tree_.bodies()[body].chain;
    const int count = num_pairs(static_cast<int>(chain.size()));
    std::vector<EntryPair> rows(6 * count);
    dynamics_.calc_body_rows(body, rows.data());
    for (int axis = 0; axis < 6; ++axis) {
      // A column of J^T: the velocity along the axis for a unit speed of each dof.
      Eigen::VectorXd column = Eigen::VectorXd::Zero(tree_.num_dofs());
      column[axis] = 1;
      for (int above = body; above > 0; above = tree_.bodies()[above].parent) {
        const SpatialVector& motion = dynamics_.motion(above);
        column[tree_.bodies()[above].dof] +=
            axis < 3 ? motion.angular[axis] : motion.linear[axis - 3];
      }
      expect_row(&rows[axis * count], chain, column);
    }
  }
}

TEST_F(TreeDynamicsTest, HasTheSameBitsWithAndWithoutAvx2) {
  if (avx2_tree_kernels() == nullptr) GTEST_SKIP() << "no AVX2";
  const int n = tree_.num_dofs();
  TreeDynamics generic(tree_, false, generic_tree_kernels());
  TreeDynamics avx2(tree_, false, *avx2_tree_kernels());
  for (int round = 0; round < 10; ++round) {
    randomize();
    std::vector<double> results[2];
    for (int i = 0; i < 2; ++i) {
      TreeDynamics& dynamics = i == 0 ? generic : avx2;
      std::vector<double>& result = results[i];
      const auto add = [&result](const auto& matrix) {
        result.insert(result.end(), matrix.data(), matrix.data() + matrix.size());
      };
      dynamics.update_kinematics(state_);
      dynamics.update_velocities(state_);
      dynamics.update_mass_matrix();
      Eigen::VectorXd vector = Eigen::VectorXd::Zero(n);
      dynamics.calc_bias({0.1, 0.2, -9.8}, vector);
      add(vector);
      Eigen::MatrixXd mass;
      dynamics.copy_mass_matrix(mass);
      add(mass);
      dynamics.factorize(Eigen::VectorXd::Constant(n, 0.01));
      for (int dof = 0; dof < n; ++dof) {
        const double* row = dynamics.inverse_row(dof)->data();
        result.insert(result.end(), row, row + tree_.dof_ancestors(dof).size() + 1);
        result.push_back(dynamics.inverse_square(dof));
      }
      for (int body = 0; body < tree_.num_bodies(); ++body) {
        add(dynamics.rotation(body));
        add(dynamics.position(body));
        std::vector<EntryPair> rows(6 * num_pairs(n), EntryPair::Zero());
        dynamics.calc_body_rows(body, rows.data());
        for (const EntryPair& pair : rows) add(pair);
      }
    }
    EXPECT_EQ(results[0], results[1]);
  }
}

TEST_F(TreeDynamicsTest, FactorSolvesWithAnAddedDiagonal) {
  randomize();
  dynamics_.update_mass_matrix();
  Eigen::VectorXd diagonal(tree_.num_dofs());
  for (double& x : diagonal) x = std::uniform_real_distribution<double>(0, 0.1)(random_);
  const Eigen::VectorXd expected = Eigen::VectorXd::Random(tree_.num_dofs());
  Eigen::VectorXd x(tree_.num_dofs());
  dynamics_.multiply_by_mass(expected, x);
  x += diagonal.cwiseProduct(expected);
  dynamics_.factorize(diagonal);
  dynamics_.solve_upper(x);
  dynamics_.solve_lower(x);
  EXPECT_LT((x - expected).cwiseAbs().maxCoeff(), 1e-10);
}

}  // namespace
}  // namespace nao::sim
