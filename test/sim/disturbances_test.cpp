#include "sim/disturbances.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <set>

#include "common/error.h"
#include "common/random.h"
#include "sim/disturbance_draw.h"
#include "test/sim/sim_fixture.h"

namespace nao::sim {
namespace {

using testing::HasSubstr;

std::string text_of(const std::string& name) {
  std::ifstream file(data_path() / "disturbances" / (name + ".yaml"));
  return {std::istreambuf_iterator<char>(file), {}};
}

void expect_rejected(const std::string& text, const std::vector<std::string>& reasons) {
  try {
    DisturbanceSet::parse(text, "file.yaml");
    ADD_FAILURE() << "accepted: " << text;
  } catch (const ConfigError& error) {
    for (const std::string& reason : reasons) EXPECT_THAT(error.what(), HasSubstr(reason));
  }
}

RobotOptions drawn(const DisturbanceSet& set, uint64_t seed) {
  WorldOptions world;
  draw_world(set, seed, world);
  RobotOptions robot;
  draw_robot(set, seed, 0, *nao_model(), world, robot);
  return robot;
}

TEST(Disturbances, ReadsTheFilesOfTheProject) {
  EXPECT_TRUE(DisturbanceSet::find("none").is_none());
  EXPECT_EQ(DisturbanceSet::find("default").keys().size(), 3u);
  for (const std::string name : {"moderate", "real"}) {
    const DisturbanceSet set = DisturbanceSet::find(name);
    EXPECT_EQ(set.name(), name);
    for (size_t i = 0; i < kNumDisturbances; ++i) {
      EXPECT_TRUE(set.entry(static_cast<Disturbance>(i))) << name << ": " << disturbance_names()[i];
    }
  }
}

TEST(Disturbances, NamesFileLineAndAllowedKeysOfAnUnknownOne) {
  expect_rejected(
      "friction: {value: 1, unit: \"1\", per: robot, source: x}\n"
      "fricton: {value: 1, unit: \"1\", per: robot, source: x}\n",
      {"file.yaml:2", "fricton", "is unknown", "friction", "backlash", "tick_ms"});
  expect_rejected("backlash:\n  toe: {value: 1, unit: deg, per: joint, source: x}\n",
                  {"file.yaml:2", "backlash.toe", "ankle"});
}

TEST(Disturbances, RejectsWhatItDoesNotUnderstand) {
  expect_rejected("friction: 0.5", {"friction"});
  expect_rejected("friction: {value: 1, unit: m, per: robot, source: x}", {"unit", "must be 1"});
  expect_rejected("friction: {value: 1, unit: \"1\", per: joint, source: x}", {"per", "robot"});
  expect_rejected("friction: {value: 1, unit: \"1\", per: robot}", {"source"});
  expect_rejected("friction: {unit: \"1\", per: robot, source: x}", {"exactly one"});
  expect_rejected("friction: {value: 1, sigma: 1, unit: \"1\", per: robot, source: x}",
                  {"exactly one"});
  expect_rejected("friction: {uniform: [1, 0.5], unit: \"1\", per: robot, source: x}",
                  {"lower and an upper"});
  expect_rejected("friction: {uniform: [1], unit: \"1\", per: robot, source: x}", {"two numbers"});
  expect_rejected("friction: {value: -1, unit: \"1\", per: robot, source: x}", {"outside"});
  expect_rejected("friction: {value: .nan, unit: \"1\", per: robot, source: x}", {"finite"});
  expect_rejected("mass_scale: {sigma: 1, unit: \"1\", per: robot, source: x}", {"uniform"});
  expect_rejected("[1, 2", {"YAML"});
  EXPECT_THROW(DisturbanceSet::find("frictoin"), ConfigError);
  EXPECT_THROW(DisturbanceSet::find("friction,,mass_scale"), ConfigError);
  EXPECT_THROW(DisturbanceSet::find(""), ConfigError);
  EXPECT_THROW(DisturbanceSet::find("../robots/nao/robot"), ConfigError);
}

TEST(Disturbances, SurvivesDamagedFiles) {
  // Cut off, bytes changed, lines doubled or deleted: read or rejected, and nothing else.
  const std::string text = text_of("real");
  Random random(5);
  int num_rejected = 0;
  for (int i = 0; i < 2000; ++i) {
    std::string damaged = text;
    const auto at = [&] { return static_cast<size_t>(random.uniform(0, damaged.size() - 1.0)); };
    const double kind = random.uniform();
    if (kind < 0.2) {
      damaged.resize(at());
    } else if (kind < 0.8) {
      for (int k = 0; k < 3; ++k) damaged[at()] = static_cast<char>(random.next() & 0x7f);
    } else {
      const size_t begin = at();
      damaged.insert(at(), damaged.substr(begin, 40));
    }
    try {
      drawn(DisturbanceSet::parse(damaged, "damaged"), 1);
    } catch (const ConfigError&) {
      ++num_rejected;
    }
  }
  EXPECT_GT(num_rejected, 500);
  EXPECT_LT(num_rejected, 2000);
}

TEST(Disturbances, AreTheSameWhateverElseDisturbsTheRobot) {
  const RobotOptions all = drawn(DisturbanceSet::find("real"), 11);
  const RobotOptions two = drawn(DisturbanceSet::find("joint_zero,torso_com"), 11);
  EXPECT_EQ(all.errors.joint_zero, two.errors.joint_zero);
  EXPECT_EQ(all.errors.torso_com, two.errors.torso_com);
  EXPECT_EQ(two.errors.backlash.size(), 0);
  EXPECT_EQ(two.friction_scale, 1);
  EXPECT_FALSE(two.ideal_sensors);
  EXPECT_EQ(two.command_latency_ticks, 1);
  EXPECT_NE(drawn(DisturbanceSet::find("joint_zero"), 12).errors.joint_zero, two.errors.joint_zero);
}

TEST(Disturbances, DoNotDependOnTheOrderOfKeys) {
  const std::string friction =
      "friction: {uniform: [0.4, 1], unit: \"1\", per: robot, source: x}\n";
  const std::string com = "torso_com: {uniform: [-5, 5], unit: mm, per: robot, source: x}\n";
  const RobotOptions a = drawn(DisturbanceSet::parse(friction + com, "a"), 3);
  const RobotOptions b = drawn(DisturbanceSet::parse(com + friction, "b"), 3);
  EXPECT_EQ(a.friction_scale, b.friction_scale);
  EXPECT_EQ(a.errors.torso_com, b.errors.torso_com);
}

TEST(Disturbances, DefaultTakesTheSeedsFirstNumbers) {
  for (uint64_t seed = 1; seed <= 100; ++seed) {
    Random random(seed);
    const double friction = random.uniform(0.5, 1.0) / 0.8;
    const double mass = random.uniform(0.97, 1.03);
    const int latency = random.uniform(0, 1) < 0.5 ? 1 : 2;
    const RobotOptions robot = drawn(DisturbanceSet::find("default"), seed);
    EXPECT_EQ(robot.friction_scale, friction);
    EXPECT_EQ(robot.mass_scale, mass);
    EXPECT_EQ(robot.command_latency_ticks, latency);
  }
}

// Numbers that seed 7 drew before there were entries for servos: earlier results stay repeatable.
TEST(Disturbances, FurtherEntriesLeaveWhatASeedDrew) {
  const RobotOptions robot = drawn(DisturbanceSet::find("real"), 7);
  EXPECT_DOUBLE_EQ(robot.friction_scale, 0.79237231129345354);
  EXPECT_DOUBLE_EQ(robot.torque_scale, 0.88940950113561346);
  EXPECT_DOUBLE_EQ(robot.errors.joint_zero[0], 0.0047963888856702164);
  EXPECT_DOUBLE_EQ(robot.errors.torso_com.x(), 0.00020462146206077104);
}

TEST(Disturbances, RealIsWithinItsRanges) {
  const DisturbanceSet real = DisturbanceSet::find("real");
  int num_dead = 0;
  std::set<double> zeros;
  for (uint64_t seed = 1; seed <= 500; ++seed) {
    WorldOptions world;
    draw_world(real, seed, world);
    EXPECT_EQ(world.steps_per_tick, 6);
    EXPECT_LE(std::acos(-world.gravity.z() / kGravity), 1.0001 * M_PI / 180);
    EXPECT_NEAR(world.gravity.norm(), kGravity, 1e-12);
    EXPECT_EQ(world.floor.bump_height, 0.002);
    EXPECT_GE(world.materials.contact_stiffness, 5e3);
    EXPECT_LE(world.materials.contact_stiffness, 5e4);
    RobotOptions robot;
    draw_robot(real, seed, 0, *nao_model(), world, robot);
    EXPECT_EQ(robot.command_latency_ticks, 3);
    EXPECT_NEAR(robot.errors.backlash[nao_model()->find_motor("RKneePitch")], 1.4 * M_PI / 180,
                1e-12);
    EXPECT_NEAR(robot.errors.backlash[nao_model()->find_motor("LAnkleRoll")], 1.0 * M_PI / 180,
                1e-12);
    EXPECT_NEAR(robot.errors.backlash[nao_model()->find_motor("LElbowYaw")], 1.5 * M_PI / 180,
                1e-12);
    for (const auto& factor : {robot.errors.servo_stiffness, robot.errors.servo_damping}) {
      EXPECT_GE(factor.minCoeff(), 0.7);
      EXPECT_LE(factor.maxCoeff(), 1.3);
      // Two joints of one joint group, and one of another.
      EXPECT_EQ(factor[nao_model()->find_motor("LHipPitch")],
                factor[nao_model()->find_motor("LHipRoll")]);
      EXPECT_NE(factor[nao_model()->find_motor("LHipPitch")],
                factor[nao_model()->find_motor("RHipPitch")]);
    }
    EXPECT_NE(robot.errors.servo_stiffness, robot.errors.servo_damping);
    zeros.insert(robot.errors.joint_zero[0]);
    num_dead += static_cast<int>((robot.errors.foot_sensor_scale.array() == 0).count());
  }
  EXPECT_EQ(zeros.size(), 500u);
  // A fifth of the robots; three standard deviations of the binomial distribution.
  EXPECT_NEAR(num_dead, 100, 27);
}

TEST(Disturbances, OfSeveralRobotsDiffer) {
  const DisturbanceSet real = DisturbanceSet::find("real");
  RobotOptions first;
  RobotOptions second;
  draw_robot(real, 1, 0, *nao_model(), {}, first);
  draw_robot(real, 1, 1, *nao_model(), {}, second);
  EXPECT_NE(first.errors.joint_zero, second.errors.joint_zero);
  EXPECT_NE(first.mass_scale, second.mass_scale);
}

}  // namespace
}  // namespace nao::sim
