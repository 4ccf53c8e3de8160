#include "daemons/robot/measurement.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "test/daemons/robot/lola_nao.h"

namespace nao::robot {
namespace {

class Reader : public testing::Test {
 protected:
  LolaState frame_ = frame_of("Stand", 1);
  MeasurementReader reader_{nao_model(), nao_map()};
};

TEST_F(Reader, ConvertsUnitsAndSigns) {
  frame_.accelerometer = {-1, -2, -9};
  frame_.gyroscope = {0.1f, 0.2f, 0.3f};
  frame_.fsr = {1, 0, 0, 0, 0, 0, 0, 2};
  frame_.touch[0] = 1;
  frame_.sonar = {0.5f, 1.5f};
  const Measurement& measured = reader_.read(frame_, 0.012);
  EXPECT_TRUE(measured.accelerometer.isApprox(Eigen::Vector3d(1, 2, 9)));
  EXPECT_TRUE(measured.gyroscope.isApprox(Eigen::Vector3d(0.1, 0.2, 0.3), 1e-6));
  EXPECT_NEAR(measured.foot_force[0], 9.81, 1e-6);
  EXPECT_NEAR(measured.foot_force[7], 19.62, 1e-6);
  EXPECT_TRUE(measured.is_touched[0]);
  EXPECT_EQ(measured.sonar_range[1], 1.5);
  EXPECT_NEAR(measured.battery_charge, 0.9, 1e-6);
  EXPECT_EQ(measured.battery_current, -1);
  EXPECT_EQ(measured.battery_temperature, 30);
}

TEST_F(Reader, VelocitiesAreDifferencesOverTheTimeOfLostFrames) {
  reader_.read(frame_, 0);
  const auto motor = static_cast<size_t>(nao_map().joints[0].motor);
  EXPECT_EQ(reader_.measurement().velocity[motor], 0);
  frame_.position[0] += 0.024f;
  EXPECT_NEAR(reader_.read(frame_, 0.012).velocity[motor], 2, 1e-4);
  frame_.position[0] += 0.024f;
  EXPECT_NEAR(reader_.read(frame_, 0.024).velocity[motor], 1, 1e-4);
}

TEST_F(Reader, TellsWhichHalfOfTheInertialUnitIsNew) {
  reader_.read(frame_, 0);
  frame_.gyroscope[0] += 0.01f;
  reader_.read(frame_, 0.012);
  EXPECT_TRUE(reader_.measurement().is_gyroscope_new);
  EXPECT_FALSE(reader_.measurement().is_accelerometer_new);
  frame_.accelerometer[0] += 0.01f;
  reader_.read(frame_, 0.012);
  EXPECT_FALSE(reader_.measurement().is_gyroscope_new);
  EXPECT_TRUE(reader_.measurement().is_accelerometer_new);
}

TEST_F(Reader, OrientationHasTheRobotsTiltAndTheGyroscopesHeading) {
  frame_.angles = {0.1f, 0.2f};
  frame_.gyroscope = {0, 0, 1};
  reader_.read(frame_, 0);
  for (int i = 0; i < 83; ++i) reader_.read(frame_, 0.012);
  const Eigen::Matrix3d rotation = reader_.measurement().orientation.toRotationMatrix();
  EXPECT_NEAR(std::atan2(rotation(2, 1), rotation(2, 2)), 0.1, 1e-6);
  EXPECT_NEAR(-std::asin(rotation(2, 0)), 0.2, 1e-6);
  // About a tilted axis: w_z cos(roll) / cos(pitch).
  EXPECT_NEAR(std::atan2(rotation(1, 0), rotation(0, 0)),
              83 * 0.012 * std::cos(0.1) / std::cos(0.2), 1e-5);
  EXPECT_NEAR(reader_.measurement().tilt(), 0.2, 1e-6);
}

TEST_F(Reader, NumbersThatAreNotFiniteKeepTheLastOnes) {
  const Measurement before = reader_.read(frame_, 0.012);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float inf = std::numeric_limits<float>::infinity();
  frame_.position.fill(nan);
  frame_.stiffness.fill(inf);
  frame_.accelerometer.fill(nan);
  frame_.gyroscope.fill(-inf);
  frame_.angles.fill(nan);
  frame_.fsr.fill(inf);
  frame_.battery.fill(nan);
  const Measurement& after = reader_.read(frame_, 0.012);
  EXPECT_EQ(after.position, before.position);
  EXPECT_EQ(after.stiffness, before.stiffness);
  EXPECT_EQ(after.accelerometer, before.accelerometer);
  EXPECT_EQ(after.gyroscope, before.gyroscope);
  EXPECT_EQ(after.battery_charge, before.battery_charge);
  EXPECT_EQ(after.foot_force, before.foot_force);
  EXPECT_TRUE(after.orientation.coeffs().allFinite());
}

}  // namespace
}  // namespace nao::robot
