// Motion without contact.

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "common/random.h"
#include "sim/world.h"
#include "test/sim/sim_fixture.h"
#include "test/sim/test_robots.h"

namespace nao::sim {
namespace {

using Eigen::Vector3d;

void switch_off_servos(World& world, int robot) {
  MotorTargets targets = world.targets(robot);
  targets.stiffness.setZero();
  world.set_targets(robot, targets);
  // Longer than the command latency.
  world.step_tick();
  world.step_tick();
}

TEST(FreeMotion, FallsByGravityExceptForTheErrorOfSemiImplicitEuler) {
  World world{SceneFile{}};
  RobotOptions options;
  options.height = 10;
  const int robot = world.add_robot(nao_model(), options);
  const double start = world.robot(robot).dynamics().center_of_mass().z();
  for (int i = 0; i < 500; ++i) world.step();
  const double fallen = start - world.robot(robot).dynamics().center_of_mass().z();
  // The velocity used in a step is the one at its end: h t g / 2 too far. Working servos have no
  // influence.
  EXPECT_NEAR(fallen, 9.81 / 2 + 9.81 * 0.002 / 2, 1e-10);
}

TEST(FreeMotion, AgreesWithFineStepsWhileAllServosMove) {
  const auto fall = [](double step) {
    WorldOptions options;
    options.step = step;
    options.steps_per_tick = static_cast<int>(std::lround(0.01 / step));
    auto world = std::make_unique<World>(SceneFile{}, options);
    RobotOptions how;
    how.height = 10;
    how.command_latency_ticks = 0;
    world->add_robot(nao_model(), how);
    MotorTargets targets = world->targets(0);
    for (int tick = 0; tick < 50; ++tick) {
      for (int i = 0; i < targets.position.size(); ++i) {
        targets.position[i] =
            nao_model()->find_posture("StandInit")->position[static_cast<size_t>(i)] +
            0.3 * std::sin(0.01 * tick * (3 + 0.3 * i));
      }
      world->set_targets(0, targets);
      world->step_tick();
    }
    return world;
  };
  const auto coarse = fall(0.002);
  const auto fine = fall(0.0001);
  const TreeState& a = coarse->robot(0).state();
  const TreeState& b = fine->robot(0).state();
  // Joints swing at 1 to 3 rad/s: a lag of half a step would be 1 to 3 mrad.
  EXPECT_LT((a.coordinate - b.coordinate).cwiseAbs().maxCoeff(), 3e-4);
  EXPECT_LT(a.orientation.angularDistance(b.orientation), 1e-4);
}

TEST(FreeMotion, RotatesInAFallAsWithoutGravity) {
  const auto orientation_after = [](double gravity) {
    WorldOptions options;
    options.gravity = {0, 0, -gravity};
    World world(SceneFile{}, options);
    RobotOptions how;
    how.height = 10;
    how.posture = "Crouch";
    world.add_robot(nao_model(), how);
    MotorTargets targets = world.targets(0);
    for (double& x : targets.position) x += 0.3;
    world.set_targets(0, targets);
    for (int i = 0; i < 100; ++i) world.step_tick();
    return world.robot(0).state().orientation;
  };
  EXPECT_LT(orientation_after(9.81).angularDistance(orientation_after(0)), 1e-9);
}

TEST(FreeMotion, PendulumSwingsAtItsPeriodAndKeepsItsEnergy) {
  World world{SceneFile{}};
  RobotOptions options;
  options.posture = "Start";
  options.is_on_stand = true;
  options.height = 1;
  const int robot = world.add_robot(make_pendulum(ideal_motor()), options);
  const Posture lifted{"Lifted", {0.1}, "standing"};
  world.place_robot(robot, &lifted, {0, 0, 1});
  switch_off_servos(world, robot);
  const double energy = world.energy();
  double first = -1;
  double last = 0;
  int periods = -1;
  for (int i = 0; i < 20000; ++i) {
    const double before = world.robot(robot).state().coordinate[6];
    const double time = world.time();
    world.step();
    const double after = world.robot(robot).state().coordinate[6];
    EXPECT_NEAR(world.energy(), energy, 1e-4);
    if (before < 0 && after >= 0) {
      last = time + world.options().step * -before / (after - before);
      if (first < 0) first = last;
      ++periods;
    }
  }
  // Physical pendulum: I = 0.01 + 0.5 * 0.3^2, m g d = 0.5 * 9.81 * 0.3; second term of the series
  // in the amplitude.
  const double expected = 2 * M_PI * std::sqrt(0.055 / 1.4715) * (1 + 0.1 * 0.1 / 16);
  EXPECT_NEAR((last - first) / periods / expected, 1, 1e-5);
}

TEST(FreeMotion, KeepsMomentumWhileMotorsMove) {
  WorldOptions options;
  options.gravity.setZero();
  World world{SceneFile{}, options};
  RobotOptions how;
  how.height = 1;
  const int robot = world.add_robot(nao_model(), how);
  world.push(robot, nao_model()->find_link("LFoot"), {0.3, 0.6, 0.3});
  // Momentum is compared while the joints rest: in between it is that of a configuration half a
  // step away.
  const auto rest = [&](const std::vector<double>& position) {
    MotorTargets targets = world.targets(robot);
    for (size_t i = 0; i < position.size(); ++i) {
      targets.position[static_cast<long>(i)] = position[i];
    }
    world.set_targets(robot, targets);
    for (int i = 0; i < 300; ++i) world.step_tick();
  };
  rest(nao_model()->find_posture("StandInit")->position);
  const TreeDynamics& dynamics = world.robot(robot).dynamics();
  const Vector3d linear = dynamics.linear_momentum();
  const Vector3d angular = dynamics.angular_momentum();
  EXPECT_NEAR(linear.norm(), std::sqrt(0.3 * 0.3 + 0.6 * 0.6 + 0.3 * 0.3), 1e-3);
  EXPECT_GT(angular.norm(), 0.05);
  Random random(3);
  for (int i = 0; i < 20; ++i) {
    MotorTargets targets = world.targets(robot);
    for (double& x : targets.position) x += 0.5 * random.normal();
    world.set_targets(robot, targets);
    for (int k = 0; k < 20; ++k) world.step_tick();
  }
  rest(nao_model()->find_posture("StandInit")->position);
  EXPECT_LT((dynamics.linear_momentum() - linear).norm(), 1e-3 * linear.norm());
  EXPECT_LT((dynamics.angular_momentum() - angular).norm(), 1e-2 * angular.norm());
}

/** Two bodies on an axis without friction, stops or motor. */
std::shared_ptr<const RobotModel> make_free_pair() {
  return make_robot(R"(<robot name="pair"><link name="torso">
    <inertial><origin xyz="0.1 0 0.2"/><mass value="1"/>
      <inertia ixx="0.01" iyy="0.012" izz="0.004" ixy="0" ixz="0" iyz="0"/></inertial></link>
    <joint name="Swing" type="revolute"><parent link="torso"/><child link="rod"/>
      <axis xyz="0 1 0"/><limit lower="-1000" upper="1000" effort="3" velocity="6"/></joint>
    <link name="rod"><inertial><origin xyz="0 0.05 -0.3"/><mass value="0.5"/>
      <inertia ixx="0.01" iyy="0.01" izz="0.001" ixy="0" ixz="0" iyz="0"/></inertial></link>
    </robot>)",
                    "{Swing: motor}", ideal_motor(), "[[-1, -1], [1, -1], [1, 1], [-1, 1]]",
                    "{Swing: 0}");
}

TEST(FreeMotion, KeepsTheEnergyOfALimpTumblingBody) {
  WorldOptions options;
  options.gravity = Vector3d::Zero();
  World world(SceneFile{}, options);
  RobotOptions how;
  how.posture = "Start";
  how.height = 10;
  const int robot = world.add_robot(make_free_pair(), how);
  switch_off_servos(world, robot);
  world.push(robot, world.robot(robot).model().find_link("rod"), {1, 0.2, 0.1});
  world.step_tick();
  const double energy = world.energy();
  double worst = 0;
  for (int i = 0; i < 500; ++i) {
    world.step_tick();
    worst = std::max(worst, std::abs(world.energy() / energy - 1));
  }
  // Coriolis forces do no work: without their effect on the joint the energy grew eightfold.
  EXPECT_LT(worst, 0.02);
}

TEST(FreeMotion, PushChangesTheMomentumByItsImpulse) {
  WorldOptions options;
  options.gravity.setZero();
  World world{SceneFile{}, options};
  RobotOptions how;
  how.height = 1;
  const int robot = world.add_robot(nao_model(), how);
  const Vector3d impulse(0.1, -0.2, 0.3);
  world.push(robot, nao_model()->find_link("RWrist"), impulse);
  world.step();
  EXPECT_LT((world.robot(robot).dynamics().linear_momentum() - impulse).norm(), 1e-3);
}

}  // namespace
}  // namespace nao::sim
