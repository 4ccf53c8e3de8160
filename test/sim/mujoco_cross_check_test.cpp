// Comparison with the same robot in MuJoCo: built only where that is installed.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "common/random.h"
#include "sim/mujoco_baseline.h"
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

TEST_F(MujocoCrossCheck, HasTheSameCenterOfMassMassMatrixAndGravityTorques) {
  const SimRobot& robot = world_.robot(0);
  const Tree& tree = robot.tree();
  MujocoBaseline baseline(robot, world_.options());
  const mjModel& model = baseline.model();
  EXPECT_NEAR(mj_getTotalmass(&model), tree.total_mass(), 1e-9);
  TreeDynamics dynamics(tree);
  Eigen::VectorXd bias = Eigen::VectorXd::Zero(tree.num_dofs());
  for (int trial = 0; trial < 50; ++trial) {
    const TreeState state = random_state();
    baseline.set_state(tree, state);
    dynamics.update_kinematics(state);
    dynamics.update_mass_matrix();
    dynamics.calc_bias({0, 0, -9.81}, bias);
    for (int k = 0; k < 3; ++k) {
      EXPECT_NEAR(dynamics.center_of_mass()[k], baseline.data().subtree_com[3 + k], 1e-9);
    }
    std::vector<mjtNum> full(static_cast<size_t>(model.nv * model.nv));
    mj_fullM(&model, full.data(), baseline.data().qM);
    // MuJoCo's dofs of our dof: two for the coupled hip joints. Only joints are compared one by
    // one: MuJoCo's angular velocity of the root is about the root's own axes.
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
      for (const int row : dofs_of(i)) gravity += baseline.data().qfrc_bias[row];
      EXPECT_NEAR(bias[i], gravity, 1e-9);
      const int motor_body = tree.body_of_dof(i);
      for (int j = 6; j <= i; ++j) {
        double entry = 0;
        for (const int row : dofs_of(i)) {
          for (const int column : dofs_of(j)) entry += full[row * model.nv + column];
        }
        if (i == j) {
          // Our mass matrix does not contain the rotors.
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

TEST_F(MujocoCrossCheck, FallsAlikeForASecondWhileAllServosMove) {
  WorldOptions options;
  options.step = 0.0001;
  options.steps_per_tick = 100;
  World world{SceneFile{}, options};
  world.add_robot(nao_model(), in_the_air());
  const SimRobot& robot = world.robot(0);
  MujocoBaseline baseline(robot, options, {BaselineFeet::kPoints, BaselineLaws::kMatched});
  MotorTargets targets = world.targets(0);
  for (int tick = 0; tick < 100; ++tick) {
    const Posture& start = *nao_model()->find_posture("StandInit");
    for (int i = 0; i < nao_model()->num_motors(); ++i) {
      targets.position[i] = start.position[i] + 0.3 * std::sin(0.01 * tick * (3 + 0.3 * i));
    }
    // The legs must not touch: edges are rounded here, and sharp in MuJoCo.
    targets.position[nao_model()->find_motor("LHipRoll")] += 0.25;
    targets.position[nao_model()->find_motor("RHipRoll")] -= 0.25;
    world.set_targets(0, targets);
    baseline.set_targets(targets.position);
    world.step_tick();
    for (int i = 0; i < options.steps_per_tick; ++i) baseline.step();
  }
  const TreeState theirs = baseline.state(robot.tree());
  // The motion of half a step is between the two: our velocities belong to the middle of a step.
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
  MujocoBaseline baseline(robot, world.options());
  for (int i = 0; i < 500; ++i) world.step_tick();
  for (int i = 0; i < 2500; ++i) baseline.step();
  const TreeState theirs = baseline.state(robot.tree());
  EXPECT_NEAR(robot.state().position.z(), theirs.position.z(), 1e-3);
  EXPECT_LT((robot.state().coordinate - theirs.coordinate).cwiseAbs().maxCoeff(), 1e-2);
}

}  // namespace
}  // namespace nao::sim
