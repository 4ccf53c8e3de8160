#include "sim/world.h"

#include <gtest/gtest.h>

#include <cstring>

#include "common/error.h"
#include "common/random.h"
#include "test/sim/sim_fixture.h"
#include "test/sim/test_robots.h"

namespace nao::sim {
namespace {

using Eigen::Vector3d;

/** The whole state of a world, as bytes. */
std::string bytes_of(const World& world) {
  std::string result;
  const auto append = [&result](const double* data, long count) {
    result.append(reinterpret_cast<const char*>(data), sizeof(double) * static_cast<size_t>(count));
  };
  for (int i = 0; i < world.num_robots(); ++i) {
    const TreeState& state = world.robot(i).state();
    append(state.position.data(), 3);
    append(state.orientation.coeffs().data(), 4);
    append(state.coordinate.data(), state.coordinate.size());
    append(state.velocity.data(), state.velocity.size());
    append(world.sensors(i).gyroscope.data(), 3);
    append(world.sensors(i).foot_force.data(), world.sensors(i).foot_force.size());
  }
  append(world.ball().position.data(), 3);
  append(world.ball().velocity.data(), 3);
  return result;
}

/** Random targets, pushes and kicks. @return The states of all ticks, as bytes. */
std::string shaken(World& world, double seconds) {
  Random random(9);
  std::string all;
  MotorTargets targets = world.targets(0);
  for (int tick = 0; tick < seconds * 100; ++tick) {
    if (tick % 6 == 0) {
      for (int i = 0; i < nao_model()->num_motors(); ++i) {
        const Joint& joint = nao_model()->motor_joint(i);
        targets.position[i] = random.uniform(joint.lower, joint.upper);
        targets.stiffness[i] = random.uniform();
      }
      world.set_targets(0, targets);
    }
    if (tick % 150 == 0) world.push(0, 0, {random.normal(), random.normal(), 0});
    if (tick % 500 == 0) world.place_ball({0.3, 0, 0}, {random.normal(), random.normal(), 0});
    world.step_tick();
    all += bytes_of(world);
  }
  return all;
}

TEST(World, SameSeedAndCommandsGiveTheSameBits) {
  World first(SceneFile::find("soccer"));
  World second(SceneFile::find("soccer"));
  first.add_robot(nao_model());
  second.add_robot(nao_model());
  const std::string states = shaken(first, 60);
  EXPECT_TRUE(states == shaken(second, 60));
  EXPECT_EQ(first.num_bad_states(), 0);
}

TEST(World, ResetRestoresTheStartExceptForNoise) {
  WorldOptions options;
  World world(SceneFile::find("soccer"), options);
  RobotOptions how;
  how.ideal_sensors = true;
  world.add_robot(nao_model(), how);
  const std::string first = shaken(world, 5);
  world.reset();
  EXPECT_EQ(world.tick(), 0);
  EXPECT_EQ(world.time(), 0);
  EXPECT_TRUE(first == shaken(world, 5));
}

TEST(World, AnotherSeedGivesDifferentNoise) {
  WorldOptions options;
  options.seed = 2;
  World first{SceneFile{}};
  World second{SceneFile{}, options};
  first.add_robot(nao_model());
  second.add_robot(nao_model());
  first.step_tick();
  second.step_tick();
  EXPECT_NE(first.sensors(0).gyroscope, second.sensors(0).gyroscope);
  EXPECT_EQ(first.robot(0).state().position, second.robot(0).state().position);
}

TEST(World, CommandTakesEffectAfterItsLatency) {
  for (const int latency : {0, 1, 3}) {
    World world{SceneFile{}};
    RobotOptions options;
    options.command_latency_ticks = latency;
    options.ideal_sensors = true;
    world.add_robot(nao_model(), options);
    for (int i = 0; i < 100; ++i) world.step_tick();
    const int motor = nao_model()->find_motor("HeadYaw");
    const double before = world.robot(0).motor_position()[motor];
    MotorTargets targets = world.targets(0);
    targets.position[motor] = 1;
    world.set_targets(0, targets);
    int ticks = 0;
    while (std::abs(world.robot(0).motor_position()[motor] - before) < 1e-6 && ticks < 20) {
      world.step_tick();
      ++ticks;
    }
    EXPECT_EQ(ticks, latency + 1);
  }
}

TEST(World, PlacesTheRobotOnItsLowestPoint) {
  World world{SceneFile{}};
  world.add_robot(nao_model());
  for (const Posture& posture : nao_model()->postures()) {
    world.place_robot(0, &posture, {1, -2, 0});
    EXPECT_EQ(world.robot(0).state().position.x(), 1) << posture.name;
    for (int i = 0; i < 300; ++i) world.step_tick();
    // It stays about where it was placed, and does not sink or jump.
    EXPECT_NEAR(world.robot(0).state().position.x(), 1, 0.05) << posture.name;
    EXPECT_NEAR(world.robot(0).state().position.y(), -2, 0.05) << posture.name;
    EXPECT_LT(world.robot(0).state().velocity.norm(), 1e-3) << posture.name;
  }
}

/** Robots in two rows, of which neighbours may fall over one another, and a ball that rolls among
 * them, all pushed about. @return The states of all ticks, as bytes. */
std::string crowd(int num_threads, double seconds, int64_t* num_touching) {
  WorldOptions options;
  options.num_threads = num_threads;
  World world(SceneFile::find("soccer"), options);
  constexpr int kNumRobots = 6;
  for (int i = 0; i < kNumRobots; ++i) {
    RobotOptions robot;
    robot.name = "R" + std::to_string(i);
    const int column = i / 2;
    robot.position = {-2.0 + 0.5 * column, i % 2 == 0 ? -1 : 1};
    world.add_robot(nao_model(), robot);
  }
  Random random(3);
  std::string all;
  for (int tick = 0; tick < seconds * 100; ++tick) {
    if (tick % 50 == 0) {
      for (int i = 0; i < kNumRobots; ++i) {
        world.push(i, 0, {3 * random.normal(), 3 * random.normal(), 0});
      }
      world.place_ball({-1.8, 1.4, 0}, {random.normal(), -2, 0});
    }
    world.step_tick();
    for (const Contact& contact : world.contacts()) {
      *num_touching +=
          contact.a.robot >= 0 && contact.b.robot >= 0 && contact.a.robot != contact.b.robot;
    }
    all += bytes_of(world);
  }
  return all;
}

TEST(World, HasTheSameBitsWithAnyNumberOfThreads) {
  int64_t num_touching = 0;
  const std::string alone = crowd(1, 6, &num_touching);
  // Islands form and dissolve: robots fall over one another.
  EXPECT_GT(num_touching, 20);
  EXPECT_EQ(crowd(2, 6, &num_touching), alone);
  EXPECT_EQ(crowd(5, 6, &num_touching), alone);
}

/** A robot's states over some ticks, with others in the world or without. */
std::string states_of_first(int num_robots) {
  World world(SceneFile::find("soccer"));
  for (int i = 0; i < num_robots; ++i) {
    RobotOptions robot;
    robot.name = "R" + std::to_string(i);
    robot.position = {-2.0 + 1.5 * i, 1};
    world.add_robot(nao_model(), robot);
    world.push(i, 0, {0.5 * i, 1, 0});
  }
  std::string all;
  for (int tick = 0; tick < 200; ++tick) {
    world.step_tick();
    const TreeState& state = world.robot(0).state();
    all.append(reinterpret_cast<const char*>(state.velocity.data()),
               sizeof(double) * static_cast<size_t>(state.velocity.size()));
  }
  return all;
}

TEST(World, ARobotFarFromOthersMovesAsIfItWereAlone) {
  EXPECT_EQ(states_of_first(3), states_of_first(1));
}

TEST(World, PutsBackARobotThatLeftAllBounds) {
  World world{SceneFile{}};
  world.add_robot(nao_model());
  world.push(0, 0, {1e6, 0, 0});
  world.step_tick();
  EXPECT_EQ(world.num_bad_states(), 1);
  EXPECT_NEAR(world.robot(0).state().position.norm(), 0.32, 0.01);
  for (int i = 0; i < 100; ++i) world.step_tick();
  EXPECT_EQ(world.num_bad_states(), 1);
  world.push(0, 0, {std::nan(""), 0, 0});
  world.step_tick();
  EXPECT_EQ(world.num_bad_states(), 2);
  for (int i = 0; i < 100; ++i) world.step_tick();
  EXPECT_EQ(world.num_bad_states(), 2);
  EXPECT_NEAR(world.robot(0).state().position.z(), 0.32, 0.01);
}

TEST(World, CountsContactsBeyondItsMemory) {
  World world{SceneFile{}};
  RobotOptions options;
  options.posture = "Start";
  // All of the 14 x 14 spheres touch the floor except the first two: the outlines of the soles, 1
  // cm higher, replace their lowest points (CollisionModel). Memory is reserved for 64 contacts,
  // and 96 for each robot.
  constexpr int kNumDropped = 14 * 14 - 2 - (64 + 96);
  world.add_robot(make_bed_of_spheres(14), options);
  world.step();
  EXPECT_EQ(world.num_dropped_contacts(), kNumDropped);
  world.step();
  EXPECT_EQ(world.num_dropped_contacts(), 2 * kNumDropped);
  world.reset();
  EXPECT_EQ(world.num_dropped_contacts(), 0);
}

TEST(World, RejectsOptionsOutsideTheirRange) {
  WorldOptions options;
  options.step = 0;
  EXPECT_THROW(World(SceneFile{}, options), ConfigError);
  options = WorldOptions();
  options.num_threads = 0;
  EXPECT_THROW(World(SceneFile{}, options), ConfigError);
  World world{SceneFile{}};
  RobotOptions how;
  how.posture = "Headstand";
  EXPECT_THROW(world.add_robot(nao_model(), how), ConfigError);
  how = RobotOptions();
  how.mass_scale = -1;
  EXPECT_THROW(world.add_robot(nao_model(), how), ConfigError);
  EXPECT_EQ(world.num_robots(), 0);
}

TEST(World, FeetStayInPlaceForTenMinutesAndTheRobotStandsForAnHour) {
  World world{SceneFile{}};
  world.add_robot(nao_model());
  for (int i = 0; i < 200; ++i) world.step_tick();
  const auto foot = [&](int sole) -> Vector3d {
    return world.robot(0).link_pose(sole).translation();
  };
  const Vector3d left = foot(nao_model()->left_sole());
  const Vector3d right = foot(nao_model()->right_sole());
  for (int i = 0; i < 60000; ++i) world.step_tick();
  EXPECT_LT((foot(nao_model()->left_sole()) - left).norm(), 1e-4);
  EXPECT_LT((foot(nao_model()->right_sole()) - right).norm(), 1e-4);
  for (int i = 0; i < 300000; ++i) world.step_tick();
  EXPECT_LT((foot(nao_model()->left_sole()) - left).norm(), 1e-3);
  EXPECT_GT((world.robot(0).state().orientation * Vector3d::UnitZ()).z(), 0.99);
  EXPECT_NEAR(world.time(), 3602, 1e-6);
}

}  // namespace
}  // namespace nao::sim
