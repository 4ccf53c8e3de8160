// Contact and friction, of a block and of the robot.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/world.h"
#include "test/sim/sim_fixture.h"
#include "test/sim/test_robots.h"

namespace nao::sim {
namespace {

using Eigen::Vector3d;

constexpr double kFriction = 0.8;

/** A floor that is tilted by an angle about a horizontal axis. @param direction  Direction of the
 * descent, rad. */
WorldOptions incline(double angle, double direction) {
  WorldOptions options;
  options.materials.floor_friction = kFriction;
  options.gravity = 9.81 * Vector3d(std::sin(angle) * std::cos(direction),
                                    std::sin(angle) * std::sin(direction), -std::cos(angle));
  return options;
}

struct Slide {
  double distance;
  double acceleration;
};

/** Distance and acceleration of a block on an incline in 2 s, after half a second to settle. */
Slide slide(double angle, double direction) {
  World world{SceneFile{}, incline(angle, direction)};
  RobotOptions options;
  options.posture = "Start";
  const int robot = world.add_robot(make_block(), options);
  for (int i = 0; i < 250; ++i) world.step();
  const TreeState& state = world.robot(robot).state();
  const Vector3d position = state.position;
  const Vector3d velocity = state.velocity.segment<3>(3);
  for (int i = 0; i < 1000; ++i) world.step();
  return {(state.position - position).norm(), (state.velocity.segment<3>(3) - velocity).norm() / 2};
}

class Incline : public testing::TestWithParam<double> {};

TEST_P(Incline, HoldsABlockBelowTheFrictionAngle) {
  const Slide found = slide(std::atan(kFriction) - 0.005, GetParam());
  EXPECT_LT(found.distance, 1e-6);
}

TEST_P(Incline, LetsABlockSlideAboveIt) {
  const double angle = std::atan(kFriction) + 0.1;
  const Slide found = slide(angle, GetParam());
  const double expected = 9.81 * (std::sin(angle) - kFriction * std::cos(angle));
  EXPECT_NEAR(found.acceleration / expected, 1, 1e-3);
}

// Straight, along the diagonal, and in between: the friction cone is round.
INSTANTIATE_TEST_SUITE_P(Directions, Incline, testing::Values(0.0, M_PI / 4, 1.0));

/** A rod that swings from 1.4 rad into a plate below its torso. @param num_more  Shapes of the
 * torso that the rod never comes near. */
TreeState swing_into_a_plate(int num_more) {
  const auto shape = [](const std::string& xyz, const std::string& size) {
    return "<collision><origin xyz=\"" + xyz + "\"/><geometry><box size=\"" + size +
           "\"/></geometry></collision>";
  };
  const std::string inertia =
      "<inertia ixx=\"0.01\" iyy=\"0.01\" izz=\"0.01\" ixy=\"0\" ixz=\"0\" iyz=\"0\"/></inertial>";
  std::string torso = shape("0 0 -0.45", "0.1 0.1 0.1");
  for (int i = 0; i < num_more; ++i) torso += shape("0 0 2", "0.05 0.05 0.05");
  const auto robot = make_robot(
      "<robot name=\"rod\"><link name=\"torso\"><inertial><mass value=\"5\"/>" + inertia + torso +
          "</link><joint name=\"Swing\" type=\"revolute\"><parent link=\"torso\"/><child "
          "link=\"rod\"/><axis xyz=\"0 1 0\"/><limit lower=\"-1.5\" upper=\"1.5\" effort=\"3\" "
          "velocity=\"6\"/></joint><link name=\"rod\"><inertial><origin xyz=\"0 0 -0.3\"/><mass "
          "value=\"0.5\"/>" +
          inertia + shape("0 0 -0.45", "0.05 0.05 0.05") + "</link></robot>",
      "{Swing: motor}", ideal_motor(), "[[-0.1, -0.1], [0.1, -0.1], [0.1, 0.1]]", "{Swing: 1.4}");
  World world{SceneFile{}};
  RobotOptions options;
  options.posture = "Start";
  options.is_on_stand = true;
  options.height = 1;
  const int index = world.add_robot(robot, options);
  MotorTargets targets = world.targets(index);
  targets.stiffness.setZero();
  world.set_targets(index, targets);
  for (int i = 0; i < 200; ++i) world.step_tick();
  return world.robot(index).state();
}

TEST(Contact, OfARobotOfManyShapesIsThatOfOneWithFew) {
  const TreeState few = swing_into_a_plate(0);
  // The rod was stopped above 0 rad.
  EXPECT_GT(few.coordinate[6], 0.1);
  EXPECT_LT(few.coordinate[6], 0.4);
  EXPECT_EQ(swing_into_a_plate(1200).coordinate, few.coordinate);
}

TEST(Contact, NeverAddsEnergy) {
  // In the last case a hand's edge slides over a shin: the contact's normal changes its direction
  // within a step.
  const std::pair<const char*, double> cases[] = {
      {"StandInit", 1e-6}, {"LyingBack", 1e-6}, {"Sit", 1e-3}};
  for (const auto& [posture, tolerance] : cases) {
    World world{SceneFile{}};
    RobotOptions options;
    options.height = 0.5;
    options.posture = posture;
    const int robot = world.add_robot(nao_model(), options);
    MotorTargets limp = world.targets(robot);
    limp.stiffness.setZero();
    world.set_targets(robot, limp);
    world.push(robot, 0, {2, 1, 0});
    world.push(robot, nao_model()->find_link("Head"), {0, 0.5, 0});
    world.step_tick();
    world.step_tick();
    const double start = world.energy();
    double before = start;
    for (int i = 0; i < 3000; ++i) {
      world.step();
      const double now = world.energy();
      ASSERT_LT(now, before + tolerance) << posture << ", step " << i;
      before = now;
    }
    EXPECT_LT(before, 0.2 * start);
    EXPECT_LT(world.robot(robot).dynamics().kinetic_energy(), 1e-4) << posture;
  }
}

double lowest_point(const World& world, int robot) {
  const SimRobot& it = world.robot(robot);
  double lowest = 1e9;
  for (const CollisionModel::Part& part : it.collisions().parts) {
    for (int i = part.first_point; i < part.end_point; ++i) {
      const CollisionModel::Point& point = it.collisions().points[i];
      const Vector3d in_world = it.dynamics().position(part.body) +
                                it.dynamics().rotation(part.body) * point.center_in_body;
      lowest = std::min(lowest, in_world.z() - point.radius);
    }
  }
  return lowest;
}

TEST(Contact, HeavyRobotSinksInAsDeepAsALightOne) {
  const auto depth = [](const std::string& mass) {
    World world{SceneFile{}};
    RobotOptions options;
    options.posture = "Start";
    const int block = world.add_robot(make_block(mass), options);
    for (int i = 0; i < 100; ++i) world.step_tick();
    return -world.robot(block).state().position.z();
  };
  EXPECT_GT(depth("6"), 1e-4);
  EXPECT_NEAR(depth("60"), depth("6"), 1e-6);
  EXPECT_NEAR(depth("3"), depth("6") / 2, 1e-6);
}

TEST(Contact, FloorStopsAPushedBodyWithinTheStep) {
  World world{SceneFile{}};
  RobotOptions options;
  options.posture = "Start";
  options.height = 0.01;
  const int block = world.add_robot(make_block(), options);
  // 15 m/s down: 20 mm into the floor in the first step if the contact were detected after it.
  world.push(block, 0, {0, 0, -15});
  for (int i = 0; i < 50; ++i) {
    world.step();
    ASSERT_GT(lowest_point(world, block), -0.016) << "step " << i;
  }
}

TEST(Contact, RobotDoesNotFallThroughTheFloor) {
  for (int direction = 0; direction < 8; ++direction) {
    World world{SceneFile{}};
    const int robot = world.add_robot(nao_model());
    const double angle = direction * M_PI / 4;
    for (int i = 0; i < 100; ++i) world.step_tick();
    world.push(robot, 0, 5 * Vector3d(std::cos(angle), std::sin(angle), 0));
    for (int i = 0; i < 400; ++i) {
      world.step_tick();
      ASSERT_GT(lowest_point(world, robot), -0.02);
    }
    const TreeState& state = world.robot(robot).state();
    EXPECT_LT((state.orientation * Vector3d::UnitZ()).z(), 0.5) << direction;
    EXPECT_LT(state.position.z(), 0.2);
    EXPECT_GT(state.position.z(), 0.03);
    EXPECT_EQ(world.num_bad_states(), 0);
  }
}

TEST(Contact, ArmsCannotPassThroughTheLegs) {
  World world{SceneFile{}};
  RobotOptions options;
  options.is_on_stand = true;
  options.height = 0.5;
  options.posture = "StandInit";
  const int robot = world.add_robot(nao_model(), options);
  // Both forearms are pressed inwards, across the body and each other.
  MotorTargets targets = world.targets(robot);
  const auto set = [&](const char* joint, double angle) {
    targets.position[nao_model()->find_motor(joint)] = angle;
  };
  set("LShoulderPitch", 0.5);
  set("RShoulderPitch", 0.5);
  set("LShoulderRoll", -0.3);
  set("RShoulderRoll", 0.3);
  set("LElbowYaw", 0);
  set("RElbowYaw", 0);
  set("LElbowRoll", -1.2);
  set("RElbowRoll", 1.2);
  world.set_targets(robot, targets);
  for (int i = 0; i < 300; ++i) world.step_tick();
  int num_touching = 0;
  for (const Contact& contact : world.contacts()) {
    if (contact.b.kind == Surface::Kind::kRobot) ++num_touching;
  }
  EXPECT_GT(num_touching, 0);
  const double left =
      world.robot(robot).link_pose(nao_model()->find_link("LWrist")).translation().y();
  const double right =
      world.robot(robot).link_pose(nao_model()->find_link("RWrist")).translation().y();
  EXPECT_GT(left - right, 0.03);
}

TEST(Contact, TwoRobotsPushEachOtherWithOppositeForces) {
  World world{SceneFile{}};
  RobotOptions first;
  RobotOptions second;
  second.name = "OTHER";
  second.position = {0.2, 0};
  second.heading = M_PI;
  world.add_robot(nao_model(), first);
  world.add_robot(nao_model(), second);
  // Their hands touch; friction in the wrists lets the forces settle slowly.
  for (int i = 0; i < 2000; ++i) world.step_tick();
  double between = 0;
  double floor = 0;
  for (const Contact& contact : world.contacts()) {
    if (contact.b.kind == Surface::Kind::kRobot) between += contact.force_on_a.norm();
    if (contact.b.kind == Surface::Kind::kFloor) floor += contact.force_on_a.z();
  }
  EXPECT_GT(between, 0.1);
  EXPECT_NEAR(floor / (2 * 9.81 * world.robot(0).tree().total_mass()), 1, 1e-3);
}

}  // namespace
}  // namespace nao::sim
