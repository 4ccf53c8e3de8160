// The same robot in MuJoCo: built only where that is installed.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/mujoco_peer.h"
#include "sim/random.h"
#include "sim/world.h"
#include "test/sim/sim_fixture.h"

namespace nao::sim {
namespace {

using Eigen::Vector3d;

class MujocoCrossCheck : public testing::Test {
 protected:
  MujocoCrossCheck() { world_.add_robot(nao_model(), in_the_air()); }

  static RobotOptions in_the_air() {
    RobotOptions options;
    options.height = 10;
    options.command_latency_ticks = 0;
    return options;
  }

  TreeState random_state() {
    const Tree& tree = world_.robot(0).tree();
    TreeState state(tree.num_dofs());
    state.position = {random_.normal(), random_.normal(), 10};
    state.orientation =
        Eigen::Quaterniond(random_.normal(), random_.normal(), random_.normal(), random_.normal())
            .normalized();
    for (int dof = 6; dof < tree.num_dofs(); ++dof) {
      const Joint& joint = nao_model()->joints()[tree.bodies()[tree.body_of_dof(dof)].joint];
      state.coordinate[dof] = random_.uniform(joint.lower, joint.upper);
    }
    return state;
  }

  World world_{SceneFile{}};
  Random random_{6};
};

TEST_F(MujocoCrossCheck, SameMassCentreMassMatrixAndGravityTorques) {
  const SimRobot& robot = world_.robot(0);
  const Tree& tree = robot.tree();
  MujocoPeer peer(robot, world_.options());
  const mjModel& model = peer.model();
  EXPECT_NEAR(mj_getTotalmass(&model), tree.total_mass(), 1e-9);
  TreeDynamics dynamics(tree);
  Eigen::VectorXd bias = Eigen::VectorXd::Zero(tree.num_dofs());
  for (int trial = 0; trial < 50; ++trial) {
    const TreeState state = random_state();
    peer.set_state(tree, state);
    dynamics.update_kinematics(state);
    dynamics.update_mass_matrix();
    dynamics.calc_bias({0, 0, -9.81}, bias);
    for (int k = 0; k < 3; ++k) {
      EXPECT_NEAR(dynamics.center_of_mass()[k], peer.data().subtree_com[3 + k], 1e-9);
    }
    std::vector<mjtNum> full(static_cast<size_t>(model.nv * model.nv));
    mj_fullM(&model, full.data(), peer.data().qM);
    // Dof i of ours as dofs of MuJoCo: two for the shared hip motor; angles of the root are about
    // its own axes there, so only joints are compared one by one.
    const auto dofs_of = [&](int dof) {
      std::vector<int> dofs;
      for (int body = 1; body < tree.num_bodies(); ++body) {
        if (tree.bodies()[body].dof != dof) continue;
        const int joint = mj_name2id(&model, mjOBJ_JOINT, ("joint" + std::to_string(body)).c_str());
        dofs.push_back(model.jnt_dofadr[joint]);
      }
      return dofs;
    };
    for (int i = 6; i < tree.num_dofs(); ++i) {
      double gravity = 0;
      for (const int row : dofs_of(i)) gravity += peer.data().qfrc_bias[row];
      EXPECT_NEAR(bias[i], gravity, 1e-9);
      const int motor_body = tree.body_of_dof(i);
      for (int j = 6; j <= i; ++j) {
        double entry = 0;
        for (const int row : dofs_of(i)) {
          for (const int column : dofs_of(j)) entry += full[row * model.nv + column];
        }
        if (i == j) {
          // Ours is without the rotors.
          for (int motor = 0; motor < nao_model()->num_motors(); ++motor) {
            if (nao_model()->motors()[motor] == tree.bodies()[motor_body].joint) {
              entry -= nao_model()->motor(motor).reflected_inertia;
            }
          }
        }
        EXPECT_NEAR(dynamics.mass_matrix(i, j), entry, 1e-9) << i << ' ' << j;
      }
    }
  }
}

TEST_F(MujocoCrossCheck, FallsAlikeForASecondWithAllServosAtWork) {
  WorldOptions options;
  options.step = 0.0001;
  options.steps_per_tick = 100;
  World world{SceneFile{}, options};
  world.add_robot(nao_model(), in_the_air());
  const SimRobot& robot = world.robot(0);
  MujocoPeer peer(robot, options, {PeerFeet::kPoints, PeerLaws::kOurs});
  MotorTargets targets = world.targets(0);
  for (int tick = 0; tick < 100; ++tick) {
    const Posture& start = *nao_model()->find_posture("StandInit");
    for (int i = 0; i < nao_model()->num_motors(); ++i) {
      targets.position[i] = start.position[i] + 0.3 * std::sin(0.01 * tick * (3 + 0.3 * i));
    }
    // Apart: edges are rounded here, sharp there.
    targets.position[nao_model()->find_motor("LHipRoll")] += 0.25;
    targets.position[nao_model()->find_motor("RHipRoll")] -= 0.25;
    world.set_targets(0, targets);
    peer.set_targets(targets.position);
    world.step_tick();
    for (int i = 0; i < options.steps_per_tick; ++i) peer.step();
  }
  const TreeState theirs = peer.state(robot.tree());
  // Half a step's way lies between the two: speeds belong to the middle of a step here.
  EXPECT_NEAR(robot.state().position.z(), theirs.position.z(), 6e-4);
  EXPECT_LT(robot.state().orientation.angularDistance(theirs.orientation), 5e-4);
  EXPECT_LT((robot.state().coordinate - theirs.coordinate).cwiseAbs().maxCoeff(), 5e-4);
}

TEST_F(MujocoCrossCheck, CrouchesUnderItsWeightAlike) {
  World world{SceneFile{}};
  RobotOptions options;
  options.posture = "Crouch";
  world.add_robot(nao_model(), options);
  const SimRobot& robot = world.robot(0);
  MujocoPeer peer(robot, world.options());
  for (int i = 0; i < 500; ++i) world.step_tick();
  for (int i = 0; i < 2500; ++i) peer.step();
  const TreeState theirs = peer.state(robot.tree());
  EXPECT_NEAR(robot.state().position.z(), theirs.position.z(), 1e-3);
  EXPECT_LT((robot.state().coordinate - theirs.coordinate).cwiseAbs().maxCoeff(), 1e-2);
}

}  // namespace
}  // namespace nao::sim
