#include "sim/engine.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "common/constants.h"
#include "common/error.h"
#include "sim/closed_loop/closed_loop.h"
#include "sim/floor.h"
#include "sim/world.h"
#include "test/sim/sim_fixture.h"
#include "test/support/test_biped.h"

namespace nao::sim {
namespace {

using Eigen::Vector3d;

/** Properties of every engine of this build. */
class EngineTest : public testing::TestWithParam<std::string> {
 protected:
  static WorldOptions options() {
    WorldOptions options;
    options.engine = GetParam();
    return options;
  }
  static RobotOptions ideal() {
    RobotOptions options;
    options.ideal_sensors = true;
    options.command_latency_ticks = 0;
    return options;
  }
  static SceneFile with_ball() {
    BallDescription ball;
    ball.radius = 0.05;
    ball.mass = 0.045;
    ball.position = {1, 0};
    SceneFile scene;
    scene.ball = ball;
    return scene;
  }
};

TEST_P(EngineTest, FallsFreely) {
  World world(SceneFile{}, options());
  RobotOptions robot = ideal();
  robot.height = 10;
  world.add_robot(nao_model(), robot);
  const double start = world.robot(0).dynamics().center_of_mass().z();
  for (int i = 0; i < 100; ++i) world.step_tick();
  const double fallen = start - world.robot(0).dynamics().center_of_mass().z();
  // Semi-implicit Euler is wrong by g h t / 2 = 1 cm.
  EXPECT_NEAR(fallen, kGravity / 2, 0.012);
  EXPECT_LT(world.sensors(0).accelerometer.norm(), 0.1);
}

TEST_P(EngineTest, StandsOnItsFeetWhichCarryTheWeight) {
  World world(SceneFile{}, options());
  world.add_robot(nao_model(), ideal());
  const Vector3d start = world.robot(0).state().position;
  for (int i = 0; i < 300; ++i) world.step_tick();
  double force = 0;
  for (const Contact& contact : world.contacts()) force += contact.force_on_a.z();
  const double weight = kGravity * world.robot(0).tree().total_mass();
  // Three seconds after the start Simbody's robot still sways by this much.
  EXPECT_NEAR(force / weight, 1, 3e-3);
  EXPECT_NEAR(world.sensors(0).foot_force.sum() / weight, 1, 0.02);
  EXPECT_LT((world.robot(0).state().position - start).norm(), 0.01);
  EXPECT_NEAR(world.sensors(0).accelerometer.norm(), kGravity, 0.02);
}

TEST_P(EngineTest, GivesAPushedRobotTheMomentum) {
  World world(SceneFile{}, options());
  RobotOptions robot = ideal();
  robot.height = 10;
  world.add_robot(nao_model(), robot);
  world.push(0, 0, {0.3, -0.2, 0.1});
  world.step();
  world.step();
  const Vector3d momentum = world.robot(0).dynamics().linear_momentum();
  const double weight = kGravity * world.robot(0).tree().total_mass();
  const Vector3d expected(0.3, -0.2, 0.1 - 2 * weight * world.options().step);
  // In MuJoCo and Simbody the joint rates of the step belong to the new configuration already.
  EXPECT_LT((momentum - expected).norm(), 5e-3);
}

TEST_P(EngineTest, ServosOfOtherGainsMoveAJointOtherwise) {
  // Angle of the head 40 ms after a new target of 0.1 rad, without friction of a contact.
  const auto moved = [&](double stiffness, double damping, bool is_commanded = false) {
    World world(SceneFile{}, options());
    RobotOptions robot = ideal();
    robot.is_on_stand = true;
    robot.errors.servo_stiffness = Eigen::VectorXd::Constant(nao_model()->num_motors(), stiffness);
    robot.errors.servo_damping = Eigen::VectorXd::Constant(nao_model()->num_motors(), damping);
    world.add_robot(nao_model(), robot);
    const int head = nao_model()->find_motor("HeadYaw");
    MotorTargets targets = world.targets(0);
    const double start = world.sensors(0).position[head];
    targets.position[head] = start + 0.1;
    if (is_commanded) {
      targets.kp.setConstant(nao_model()->num_motors(), nao_model()->motor(head).stiffness_gain);
      targets.kd.setConstant(nao_model()->num_motors(), nao_model()->motor(head).damping_gain);
    }
    world.set_targets(0, targets);
    for (int i = 0; i < 4; ++i) world.step_tick();
    return world.sensors(0).position[head] - start;
  };
  const double nominal = moved(1, 1);
  EXPECT_GT(nominal, 0.01);
  EXPECT_GT(moved(1.3, 1), 1.05 * nominal);
  EXPECT_LT(moved(0.7, 1), 0.95 * nominal);
  EXPECT_LT(moved(1, 1.3), 0.95 * nominal);
  EXPECT_GT(moved(1, 0.7), 1.05 * nominal);
  // A servo errs in the same way with gains that a command states.
  EXPECT_NEAR(moved(0.7, 1.3, true), moved(0.7, 1.3), 1e-9);
}

// In the air the root turns against what the joints move: followers that did not follow would show.
TEST_P(EngineTest, CouplesJointsOfAnyBodies) {
  const auto model = std::make_shared<const RobotModel>(make_coupled_biped());
  const auto fall = [&](const WorldOptions& world_options) {
    World world(SceneFile{}, world_options);
    RobotOptions robot = ideal();
    robot.height = 10;
    world.add_robot(model, robot);
    MotorTargets targets = world.targets(0);
    targets.position[model->find_motor("left_knee")] = 1;
    targets.position[model->find_motor("left_shoulder_pitch")] = -1;
    targets.position[model->find_motor("left_shoulder_roll")] = 0.8;
    world.set_targets(0, targets);
    for (int i = 0; i < 100; ++i) world.step_tick();
    return world.robot(0).state();
  };
  const TreeState state = fall(options());
  const TreeState expected = fall(WorldOptions());
  EXPECT_LT((state.coordinate - expected.coordinate).cwiseAbs().maxCoeff(), 0.02);
  EXPECT_GT(expected.orientation.angularDistance(Eigen::Quaterniond::Identity()), 0.1);
  EXPECT_LT(state.orientation.angularDistance(expected.orientation), 0.02);
}

TEST_P(EngineTest, RollsABallThatSlowsDown) {
  World world(with_ball(), options());
  world.place_ball({0, 0, 0}, {1, 0, 0});
  for (int i = 0; i < 100; ++i) world.step_tick();
  // Sliding ends at 5/7 of the speed; rolling resistance takes 0.3 m/s each second.
  const double speed = world.ball().velocity.x();
  EXPECT_NEAR(speed, 5.0 / 7 - 0.3, 0.08);
  // MuJoCo's friction is soft: its ball slips by 5 cm/s.
  EXPECT_NEAR(world.ball().angular_velocity.y() * 0.05, speed, 0.06);
  EXPECT_NEAR(world.ball().position.z(), 0.05, 0.002);
}

TEST_P(EngineTest, RestsABallOnABump) {
  WorldOptions bumpy = options();
  bumpy.floor.bump_height = 0.002;
  bumpy.floor.seed = 7;
  World world(with_ball(), bumpy);
  const Floor floor(bumpy.floor);
  // Rolling resistance of 0.3 m/s^2 holds it on slopes of up to 4 %; bumps have 3 %.
  const Vector3d start(0.34, 0.57, 0);
  world.place_ball(start, Vector3d::Zero());
  for (int i = 0; i < 200; ++i) world.step_tick();
  const Vector3d center = world.ball().position;
  const Floor::Plane below = floor.at(center.x(), center.y());
  EXPECT_GT(below.height, 0.0005);
  EXPECT_NEAR(below.normal.z() * (center.z() - below.height), 0.05, 0.0005);
  // Simbody's rolling resistance is smoothed near rest: its ball creeps by 3 mm/s.
  EXPECT_LT((center - start).head<2>().norm(), 0.008);
  EXPECT_LT(world.ball().velocity.norm(), 0.004);
}

TEST_P(EngineTest, HoldsABallOnAGentleSlopeAndSlowsItDownInAllDirections) {
  WorldOptions sloping = options();
  // Downhill in y by 1 degree.
  sloping.gravity = kGravity * Vector3d(0, std::sin(M_PI / 180), -std::cos(M_PI / 180));
  World world(with_ball(), sloping);
  world.place_ball(Vector3d::Zero(), Vector3d::Zero());
  for (int i = 0; i < 100; ++i) world.step_tick();
  EXPECT_LT(world.ball().position.head<2>().norm(), 0.006);
  // A ball that rolls forward is accelerated downhill, and slowed down against its direction: the
  // components follow v' = 5/7 g sin(1 degree) e_y - 0.3 v / |v|.
  world.place_ball(Vector3d::Zero(), {1, 0, 0});
  for (int i = 0; i < 50; ++i) world.step_tick();
  Eigen::Vector2d expected = world.ball().velocity.head<2>();
  for (int i = 0; i < 100; ++i) world.step_tick();
  const double downhill = 5.0 / 7 * kGravity * std::sin(M_PI / 180);
  for (int i = 0; i < 1000; ++i) {
    expected += 1e-3 * (Eigen::Vector2d(0, downhill) - 0.3 * expected.normalized());
  }
  EXPECT_NEAR(world.ball().velocity.x(), expected.x(), 0.02);
  EXPECT_NEAR(world.ball().velocity.y(), expected.y(), 0.02);
}

TEST_P(EngineTest, HoldsAStandingRobotOnAStand) {
  World world(SceneFile{}, options());
  RobotOptions robot = ideal();
  robot.is_on_stand = true;
  robot.height = 0.5;
  world.add_robot(nao_model(), robot);
  const Vector3d start = world.robot(0).state().position;
  MotorTargets targets = world.targets(0);
  const int elbow = nao_model()->find_motor("LElbowYaw");
  targets.position[elbow] += 0.5;
  world.set_targets(0, targets);
  for (int i = 0; i < 200; ++i) world.step_tick();
  EXPECT_EQ(world.robot(0).state().position, start);
  EXPECT_NEAR(world.robot(0).motor_position()[elbow], targets.position[elbow], 0.02);
}

TEST_P(EngineTest, StandsWithAllRealDisturbances) {
  ClosedLoopOptions trial;
  trial.model = nao_model();
  trial.engine = GetParam();
  trial.disturbances = std::make_shared<DisturbanceSet>(DisturbanceSet::find("real"));
  ClosedLoop loop(trial, 1);
  EXPECT_EQ(loop.period(), 0.012);
  loop.run(3);
  EXPECT_GT(loop.torso_height(), 0.28);
  EXPECT_EQ(loop.world().num_bad_states(), 0);
  EXPECT_EQ(loop.world().num_dropped_contacts(), 0);
  for (int i = 0; i < nao_model()->num_motors(); ++i) {
    if (loop.world().robot(0).is_opening(i)) continue;
    const RobotErrors& errors = loop.world().robot(0).options().errors;
    const double offset = loop.world().sensors(0).position[i] - errors.joint_zero[i] -
                          loop.world().robot(0).motor_position()[i];
    // Half of an encoder's step and half of the play.
    EXPECT_LE(std::abs(offset), errors.backlash[i] / 2 + M_PI / 4096 + 1e-9);
  }
}

TEST_P(EngineTest, HoldsARobotOnASlope) {
  WorldOptions sloping = options();
  // Downhill in y by 5 degrees, far below the friction angle.
  const double angle = 5 * M_PI / 180;
  sloping.gravity = kGravity * Vector3d(0, std::sin(angle), -std::cos(angle));
  World world(SceneFile{}, sloping);
  world.add_robot(nao_model(), ideal());
  for (int i = 0; i < 300; ++i) world.step_tick();
  const int sole = nao_model()->left_sole();
  const Vector3d start = world.robot(0).link_pose(sole).translation();
  for (int i = 0; i < 300; ++i) world.step_tick();
  const double crept = (world.robot(0).link_pose(sole).translation() - start).norm();
  // MuJoCo's friction is soft: its robot creeps.
  EXPECT_LT(crept, GetParam() == "mujoco" ? 5e-3 : 1e-4);
}

TEST_P(EngineTest, WalksWithoutRepeatedSlidingOfItsFeet) {
  ClosedLoopOptions trial;
  trial.model = nao_model();
  trial.engine = GetParam();
  // This disturbed robot has play in its joints, so that its feet are light on a stiff floor.
  trial.disturbances = std::make_shared<DisturbanceSet>(DisturbanceSet::find("real"));
  ClosedLoop loop(trial, 501);
  loop.run(1);
  loop.hold_walk({0.2, 0, 0});
  loop.run(2.5);
  const double friction = loop.world().options().materials.floor_friction *
                          loop.world().robot(0).options().friction_scale;
  int num_sliding = 0;
  int num_ticks = 0;
  for (; num_ticks < 300; ++num_ticks) {
    loop.step();
    Vector3d force = Vector3d::Zero();
    for (const Contact& contact : loop.world().contacts()) force += contact.force_on_a;
    if (force.head<2>().norm() > 0.8 * friction * force.z()) ++num_sliding;
  }
  // The walk needs a third of this floor's friction; feet that slide, or whose friction turns
  // around from step to step, need all of it.
  EXPECT_LT(num_sliding, num_ticks / 20);
  EXPECT_LT(loop.torso_tilt(), 0.3);
}

TEST_P(EngineTest, GivesTheSameBitsAgain) {
  ClosedLoopOptions trial;
  trial.model = nao_model();
  trial.engine = GetParam();
  const auto run = [&] {
    ClosedLoop loop(trial, 4);
    loop.run(0.5);
    loop.hold_walk({0.2, 0, 0});
    loop.run(1.5);
    return loop.world().robot(0).state();
  };
  const TreeState a = run();
  const TreeState b = run();
  EXPECT_EQ(a.position, b.position);
  EXPECT_EQ(a.coordinate, b.coordinate);
  EXPECT_EQ(a.velocity, b.velocity);
}

TEST_P(EngineTest, WalksAtTheCommandedSpeed) {
  ClosedLoopOptions trial;
  trial.model = nao_model();
  trial.engine = GetParam();
  trial.is_ideal = true;
  ClosedLoop loop(trial, 1);
  loop.run(1);
  loop.hold_walk({0.2, 0, 0});
  loop.run(2.5);
  const double start = loop.torso_in_world().translation().x();
  loop.run(5);
  EXPECT_NEAR((loop.torso_in_world().translation().x() - start) / 5, 0.2, 0.02);
  EXPECT_LT(loop.torso_tilt(), 0.3);
}

TEST_P(EngineTest, ServosObeyCommandedGains) {
  WorldOptions options;
  options.engine = GetParam();
  World world{SceneFile{}, options};
  RobotOptions robot;
  robot.is_on_stand = true;
  robot.height = 1;
  robot.command_latency_ticks = 0;
  const int index = world.add_robot(nao_model(), robot);
  const int arm = nao_model()->find_motor("LShoulderPitch");
  // The arm is held ahead against gravity: it sags by torque / kp.
  const auto sag = [&](double factor) {
    MotorTargets targets = world.targets(index);
    targets.position[arm] = 0;
    targets.kp.setConstant(nao_model()->num_motors(), std::nan(""));
    targets.kd = targets.kp;
    targets.kp[arm] = factor * nao_model()->motor(arm).stiffness_gain;
    world.set_targets(index, targets);
    for (int i = 0; i < 300; ++i) world.step_tick();
    return world.robot(index).motor_position()[arm];
  };
  const double own = sag(std::nan(""));
  EXPECT_GT(own, 0);
  EXPECT_NEAR(sag(0.25) / own, 4, 1.5);
  EXPECT_NEAR(sag(std::nan("")), own, 0.25 * own);
}

INSTANTIATE_TEST_SUITE_P(All, EngineTest, testing::ValuesIn(engine_names()),
                         [](const auto& info) { return info.param; });

TEST(Engines, RejectAnUnknownName) {
  WorldOptions options;
  options.engine = "quick";
  try {
    World world(SceneFile{}, options);
    ADD_FAILURE();
  } catch (const ConfigError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("quick"));
    EXPECT_THAT(error.what(), testing::HasSubstr("fast"));
  }
}

TEST(Engines, SayHowToGetMujocoWhereItIsMissing) {
  WorldOptions options;
  options.engine = "mujoco";
  try {
    World world(SceneFile{}, options);
    EXPECT_THAT(engine_names(), testing::Contains("mujoco"));
  } catch (const ConfigError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("libmujoco-dev"));
  }
}

}  // namespace
}  // namespace nao::sim
