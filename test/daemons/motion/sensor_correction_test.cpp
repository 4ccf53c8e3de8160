#include "daemons/motion/sensor_correction.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "common/constants.h"
#include "test/daemons/motion/nao_model.h"
#include "test/daemons/motion/perfect_robot.h"

namespace nao::motion {
namespace {

using Eigen::Vector3d;

TEST(SensorCorrection, WithoutDifferencesNothingChanges) {
  const SensorCorrection correction(nao_model(), Calibration(nao_model()));
  Sensors sensors = PerfectRobot().sensors();
  sensors.gyroscope_torso = {0.1, 0.2, 0.3};
  const Sensors before = sensors;
  correction.correct(sensors);
  EXPECT_EQ(sensors.position, before.position);
  EXPECT_EQ(sensors.foot_force, before.foot_force);
  EXPECT_EQ(sensors.gyroscope_torso, before.gyroscope_torso);
  EXPECT_EQ(sensors.accelerometer_torso, before.accelerometer_torso);
}

TEST(SensorCorrection, ReadingsBecomeTheTrueValues) {
  Calibration calibration(nao_model());
  const int knee = nao_motor("LKneePitch");
  calibration.joint_zero[knee] = 0.01;
  calibration.imu_mount = {0.01, -0.02, 0};
  calibration.gyroscope_scale = {0.96, 1.04, 1};
  calibration.gyroscope_offset = {0.02, 0, -0.01};
  calibration.foot_sensor_scale[2] = 0.7;
  const SensorCorrection correction(nao_model(), calibration);

  const Vector3d up(0, 0, kGravity);
  const Vector3d rate(0.3, -0.2, 0.5);
  const Eigen::AngleAxisd mount(calibration.imu_mount.norm(), calibration.imu_mount.normalized());
  Sensors sensors = PerfectRobot().sensors();
  const double angle = sensors.position[knee];
  sensors.position[knee] += 0.01;
  sensors.target_position[knee] += 0.01;
  sensors.accelerometer_torso = mount.inverse() * up;
  sensors.gyroscope_torso = (mount.inverse() * rate).cwiseProduct(calibration.gyroscope_scale) +
                            calibration.gyroscope_offset;
  const Eigen::Quaterniond orientation(Eigen::AngleAxisd(0.3, Vector3d(1, 2, 3).normalized()));
  sensors.orientation_torso_in_world = orientation * Eigen::Quaterniond(mount);
  sensors.foot_force[2] *= 0.7;
  const double force = PerfectRobot().sensors().foot_force[2];
  correction.correct(sensors);
  EXPECT_NEAR(sensors.position[knee], angle, 1e-12);
  EXPECT_NEAR(sensors.target_position[knee], angle, 1e-12);
  EXPECT_LT(sensors.orientation_torso_in_world.angularDistance(orientation), 1e-9);
  EXPECT_LT((sensors.accelerometer_torso - up).norm(), 1e-12);
  EXPECT_LT((sensors.gyroscope_torso - rate).norm(), 1e-12);
  EXPECT_NEAR(sensors.foot_force[2], force, 1e-12);
}

TEST(SensorCorrection, ServosGetTheEncodersAngles) {
  Calibration calibration(nao_model());
  calibration.joint_zero[3] = 0.01;
  const SensorCorrection correction(nao_model(), calibration);
  std::vector<double> position(nao_model().num_motors(), 0.5);
  correction.to_servos(position);
  EXPECT_NEAR(position[3], 0.51, 1e-12);
  EXPECT_EQ(position[4], 0.5);
}

TEST(SensorCorrection, ADeadSensorGetsTheForceOfALinearPressure) {
  Calibration calibration(nao_model());
  calibration.foot_sensor_scale[1] = 0;
  const SensorCorrection correction(nao_model(), calibration);
  // The left foot's sensors are nearly a rectangle, in which the front right one would read 10 + 6
  // - 8.
  Sensors sensors = PerfectRobot().sensors();
  sensors.foot_force = {10, 0.3, 8, 6, 5, 5, 5, 5};
  correction.correct(sensors);
  EXPECT_NEAR(sensors.foot_force[1], 8, 0.3);
  EXPECT_NEAR(sensors.foot_force[5], 5, 1e-12);
  sensors.foot_force = {1, 0, 9, 1, 5, 5, 5, 5};
  correction.correct(sensors);
  EXPECT_EQ(sensors.foot_force[1], 0);
}

}  // namespace
}  // namespace nao::motion
