#include "daemons/motion/estimator/dead_foot_sensors.h"

#include <gtest/gtest.h>

#include <vector>

#include "test/daemons/motion/nao_model.h"

namespace nao::motion {
namespace {

// The NAO's sensors: front left, front right, rear left, rear right, of the left and the right
// foot; its weight is 52 N.
const std::vector<double> kStandingForces = {8, 6, 6, 4, 7, 7, 6, 6};

std::vector<double> without(std::vector<double> force, size_t sensor) {
  force[sensor] = 0;
  return force;
}

/** Forces after a number of seconds of the same reading. */
std::vector<double> after(DeadFootSensors& sensors, const std::vector<double>& reading,
                          double time) {
  std::vector<double> force;
  for (double t = 0; t < time; t += 0.01) {
    force = reading;
    sensors.update(force, 0.01);
  }
  return force;
}

TEST(DeadFootSensors, HealthyReadingsAreUnchanged) {
  DeadFootSensors sensors(nao_model());
  EXPECT_EQ(after(sensors, kStandingForces, 10), kStandingForces);
  // A foot in the air reads nothing at all.
  const std::vector<double> one_foot = {14, 13, 13, 12, 0, 0, 0, 0};
  EXPECT_EQ(after(sensors, one_foot, 10), one_foot);
  // One corner on an edge reads nothing either, and the others confirm the edge.
  const std::vector<double> heel_in_the_air = {26, 26, 0, 0, 0, 0, 0, 0};
  EXPECT_EQ(after(sensors, heel_in_the_air, 10), heel_in_the_air);
}

TEST(DeadFootSensors, ADeadSensorGetsTheForceThatTheOthersImply) {
  for (const size_t dead : {0, 1, 2, 3, 7}) {
    DeadFootSensors sensors(nao_model());
    const std::vector<double> force = after(sensors, without(kStandingForces, dead), 0.5);
    EXPECT_TRUE(sensors.is_dead()[dead]);
    // The sensors of a foot form a trapezoid, nearly a rectangle.
    EXPECT_NEAR(force[dead], kStandingForces[dead], 1.5) << dead;
    EXPECT_EQ(without(force, dead), without(kStandingForces, dead));
  }
}

TEST(DeadFootSensors, ASensorThatHasBeenLoadedNeedsMoreEvidence) {
  DeadFootSensors sensors(nao_model());
  after(sensors, kStandingForces, 0.1);
  const std::vector<double> on_a_hole = without(kStandingForces, 1);
  EXPECT_EQ(after(sensors, on_a_hole, 1), on_a_hole);
  EXPECT_FALSE(sensors.is_dead()[1]);
  after(sensors, on_a_hole, 3);
  EXPECT_TRUE(sensors.is_dead()[1]);
}

TEST(DeadFootSensors, AWalkThatLeavesACornerUnloadedMakesNoSensorDead) {
  DeadFootSensors sensors(nao_model());
  after(sensors, kStandingForces, 0.1);
  // Steps of a quarter of a second on the inner edges of the soles: one corner of each foot never
  // reads anything.
  const std::vector<double> on_left = {0, 22, 12, 18, 0, 0, 0, 0};
  const std::vector<double> on_right = {0, 0, 0, 0, 22, 0, 18, 12};
  for (int step = 0; step < 100; ++step) {
    after(sensors, step % 2 == 0 ? on_left : on_right, 0.24);
    ASSERT_EQ(sensors.is_dead(), std::vector<bool>(8, false)) << step;
  }
}

// As with joint zeros that let a robot stand on its toes until it walks.
TEST(DeadFootSensors, ADeadSensorIsFoundInAWalk) {
  DeadFootSensors sensors(nao_model());
  const std::vector<double> on_left = {0, 14, 12, 13, 0, 0, 0, 0};
  const std::vector<double> on_right = {0, 0, 0, 0, 14, 13, 13, 12};
  for (int step = 0; step < 4; ++step) after(sensors, step % 2 == 0 ? on_left : on_right, 0.24);
  EXPECT_TRUE(sensors.is_dead()[0]);
}

TEST(DeadFootSensors, ASensorThatReadsAgainIsAlive) {
  DeadFootSensors sensors(nao_model());
  EXPECT_FALSE(sensors.is_dead()[4]);
  after(sensors, without(kStandingForces, 4), 1);
  EXPECT_TRUE(sensors.is_dead()[4]);
  EXPECT_EQ(after(sensors, kStandingForces, 0.02), kStandingForces);
  EXPECT_FALSE(sensors.is_dead()[4]);
}

TEST(DeadFootSensors, WithTwoDeadSensorsOnAFootNothingIsInvented) {
  DeadFootSensors sensors(nao_model());
  const std::vector<double> reading = without(without(kStandingForces, 0), 3);
  const std::vector<double> force = after(sensors, reading, 10);
  EXPECT_EQ(force[0], 0);
  EXPECT_EQ(force[3], 0);
}

}  // namespace
}  // namespace nao::motion
