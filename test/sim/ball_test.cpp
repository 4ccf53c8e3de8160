#include <gtest/gtest.h>

#include <cmath>

#include "sim/world.h"
#include "test/sim/sim_fixture.h"

namespace nao::sim {
namespace {

using Eigen::Vector3d;

SceneFile ball_on_a_floor() {
  SceneFile scene = SceneFile::find("soccer");
  scene.goals.reset();
  scene.field.reset();
  scene.ball->position = {0, 0};
  return scene;
}

TEST(Ball, SlidesThenRollsAtFiveSeventhsOfItsSpeed) {
  WorldOptions options;
  options.materials.ball_rolling_deceleration = 0;
  World world(ball_on_a_floor(), options);
  world.place_ball({0, 0, 0}, {2, 0, 0});
  for (int i = 0; i < 50; ++i) world.step();
  EXPECT_NEAR((2 - world.ball().velocity.x()) / 0.1, options.materials.ball_friction * 9.81, 0.01);
  for (int i = 0; i < 450; ++i) world.step();
  // A solid sphere: friction turns 2/7 of the momentum into spin, whatever its coefficient.
  EXPECT_NEAR(world.ball().velocity.x(), 2 * 5.0 / 7, 1e-3);
  EXPECT_NEAR(world.ball().angular_velocity.y() * world.scene().ball->radius,
              world.ball().velocity.x(), 1e-3);
}

TEST(Ball, RollsOutWithAConstantDeceleration) {
  World world(ball_on_a_floor());
  const double deceleration = world.options().materials.ball_rolling_deceleration;
  world.place_ball({0, 0, 0}, {2, 0, 0});
  for (int i = 0; i < 150; ++i) world.step();
  const double speed = world.ball().velocity.x();
  const double start = world.ball().position.x();
  for (int i = 0; i < 5000; ++i) world.step();
  EXPECT_NEAR(world.ball().position.x() - start, speed * speed / (2 * deceleration), 0.01);
  EXPECT_LT(world.ball().velocity.norm(), 1e-6);
}

TEST(Ball, ReboundsToTheSquareOfItsRestitution) {
  World world(ball_on_a_floor());
  const double restitution = world.options().materials.ball_restitution;
  world.place_ball({0, 0, 1}, {0, 0, 0});
  double top = 0;
  bool has_bounced = false;
  for (int i = 0; i < 500; ++i) {
    world.step();
    has_bounced = has_bounced || world.ball().velocity.z() > 0.5;
    const double height = world.ball().position.z() - world.scene().ball->radius;
    if (has_bounced) top = std::max(top, height);
  }
  // The impact is somewhere within a step: 4.4 m/s * 2 ms of the height are uncertain.
  EXPECT_NEAR(top, restitution * restitution, 0.01);
}

TEST(Ball, StaysAtRestForAnHour) {
  World world(ball_on_a_floor());
  for (int i = 0; i < 1800000; ++i) world.step();
  EXPECT_LT((world.ball().position - Vector3d(0, 0, world.scene().ball->radius)).norm(), 1e-3);
}

TEST(Ball, ReboundsFromAPostAndStaysInTheNet) {
  World world(SceneFile::find("soccer"));
  const double goal_line = world.scene().field->length / 2;
  world.place_ball({goal_line - 1, world.scene().goals->post_distance / 2, 0}, {4, 0, 0});
  for (int i = 0; i < 500; ++i) world.step();
  EXPECT_LT(world.ball().velocity.x(), -0.5);

  world.place_ball({goal_line - 1, 0.2, 0}, {4, 0, 0});
  for (int i = 0; i < 5000; ++i) world.step();
  EXPECT_GT(world.ball().position.x(), goal_line);
  EXPECT_LT(world.ball().position.x(), goal_line + world.scene().goals->depth + 0.03);
}

TEST(Ball, IsKickedByASwingingLeg) {
  SceneFile scene = ball_on_a_floor();
  World world(scene);
  RobotOptions options;
  options.is_on_stand = true;
  // Feet just above the floor; the swing ends with the toes at 0.13 m, beyond the ball's surface.
  options.height = 0.02;
  const int robot = world.add_robot(nao_model(), options);
  world.place_ball({0.16, 0.05, 0}, {0, 0, 0});
  MotorTargets targets = world.targets(robot);
  const auto set = [&](const char* joint, double angle) {
    targets.position[nao_model()->find_motor(joint)] = angle;
  };
  set("LHipPitch", 0.2);
  set("LKneePitch", 0.9);
  world.set_targets(robot, targets);
  for (int i = 0; i < 50; ++i) world.step_tick();
  set("LHipPitch", -1.0);
  set("LKneePitch", 0.3);
  world.set_targets(robot, targets);
  for (int i = 0; i < 50; ++i) world.step_tick();
  EXPECT_GT(world.ball().velocity.x(), 0.5);
  for (int i = 0; i < 1000; ++i) world.step_tick();
  EXPECT_GT(world.ball().position.x(), 0.6);
}

}  // namespace
}  // namespace nao::sim
