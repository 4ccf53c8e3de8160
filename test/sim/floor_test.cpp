#include "sim/floor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "common/random.h"
#include "sim/world.h"
#include "test/sim/sim_fixture.h"

namespace nao::sim {
namespace {

FloorOptions bumpy() {
  FloorOptions options;
  options.bump_height = 0.002;
  options.seed = 7;
  return options;
}

TEST(Floor, IsFlatByDefault) {
  const Floor floor;
  EXPECT_TRUE(floor.is_flat());
  EXPECT_EQ(floor.at(0.3, -2).height, 0);
  EXPECT_EQ(floor.at(0.3, -2).normal.z(), 1);
}

TEST(Floor, IsContinuousWithinItsHeightAndTheNormalIsThatOfTheSurface) {
  const Floor floor(bumpy());
  Random random(3);
  constexpr double kDelta = 1e-7;
  double highest = 0;
  for (int i = 0; i < 20000; ++i) {
    const double x = random.uniform(-3, 3);
    const double y = random.uniform(-3, 3);
    const Floor::Plane plane = floor.at(x, y);
    ASSERT_GE(plane.height, 0);
    ASSERT_LE(plane.height, 0.002);
    highest = std::max(highest, plane.height);
    // No slope is steeper than one bump over a cell.
    EXPECT_NEAR(floor.at(x + kDelta, y).height, plane.height, 0.02 * kDelta * 1.01);
    EXPECT_NEAR(floor.at(x, y + kDelta).height, plane.height, 0.02 * kDelta * 1.01);
    EXPECT_NEAR(plane.normal.norm(), 1, 1e-12);
    const double middle_x = (std::floor(x / 0.1) + 0.6) * 0.1;
    const double middle_y = (std::floor(y / 0.1) + 0.3) * 0.1;
    const Floor::Plane inside = floor.at(middle_x, middle_y);
    const double slope = (floor.at(middle_x + kDelta, middle_y).height - inside.height) / kDelta;
    EXPECT_NEAR(slope, -inside.normal.x() / inside.normal.z(), 1e-6);
  }
  EXPECT_GT(highest, 0.0018);
}

TEST(Floor, DependsOnTheSeed) {
  FloorOptions other = bumpy();
  other.seed = 8;
  EXPECT_EQ(Floor(bumpy()).at(1, 2).height, Floor(bumpy()).at(1, 2).height);
  EXPECT_NE(Floor(bumpy()).at(1, 2).height, Floor(other).at(1, 2).height);
}

TEST(Floor, CarriesARobotAndABallOnItsBumps) {
  WorldOptions options;
  options.floor = bumpy();
  BallDescription ball;
  ball.radius = 0.05;
  ball.mass = 0.045;
  ball.position = {1, 0.53};
  SceneFile scene;
  scene.ball = ball;
  World world(scene, options);
  world.add_robot(nao_model());
  for (int i = 0; i < 300; ++i) world.step_tick();
  double force = 0;
  for (const Contact& contact : world.contacts()) {
    if (contact.a.kind == Surface::Kind::kRobot) force += contact.force_on_a.z();
  }
  EXPECT_NEAR(force, world.robot(0).tree().total_mass() * kGravity, 0.5);
  EXPECT_GT(world.robot(0).state().position.z(), 0.28);
  const Eigen::Vector3d& rest = world.ball().position;
  const Floor::Plane plane = world.floor().at(rest.x(), rest.y());
  EXPECT_NEAR((rest.z() - plane.height) * plane.normal.z(), 0.05, 2e-4);
}

TEST(Floor, TiltsTheInertialUnitOnASlope) {
  WorldOptions options;
  constexpr double kSlope = 2 * M_PI / 180;
  options.gravity = kGravity * Eigen::Vector3d(std::sin(kSlope), 0, -std::cos(kSlope));
  World world(SceneFile{}, options);
  RobotOptions robot;
  robot.ideal_sensors = true;
  world.add_robot(nao_model(), robot);
  for (int i = 0; i < 100; ++i) world.step_tick();
  // Level is what the inertial unit measures: on the slope the torso leans by its angle.
  const Eigen::Vector3d up = world.sensors(0).orientation.conjugate() * Eigen::Vector3d::UnitZ();
  EXPECT_NEAR((up - world.sensors(0).accelerometer / kGravity).norm(), 0, 0.02);
  EXPECT_LT(world.robot(0).state().position.head<2>().norm(), 0.02);
}

}  // namespace
}  // namespace nao::sim
