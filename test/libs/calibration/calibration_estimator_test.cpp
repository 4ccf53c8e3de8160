#include "calibration/calibration_estimator.h"

#include <gtest/gtest.h>

#include <cmath>

#include "calibration/calibration_run.h"
#include "common/constants.h"
#include "common/random.h"
#include "test/daemons/motion/nao_model.h"
#include "test/libs/calibration/synthetic_robot.h"

namespace nao {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using motion::nao_model;
using motion::nao_motor;

/** Stands in all poses of a calibration, in some directions. */
void stand_everywhere(SyntheticRobot& robot, int num_stations, CalibrationEstimator& estimator) {
  CalibrationRun run(nao_model(), num_stations);
  std::vector<double> position = nao_model().ready_posture().position;
  double heading = 0;
  int station = 0;
  while (!run.is_done()) {
    if (const auto command = run.next_command()) {
      if (const auto* turn = std::get_if<MoveToCommand>(&*command)) {
        heading += turn->theta;
        ++station;
      } else if (const auto* change = std::get_if<JointChangeCommand>(&*command)) {
        for (size_t i = 0; i < change->joint_names.size(); ++i) {
          position[nao_motor(change->joint_names[i].c_str())] = change->joint_position[i];
        }
        estimator.add(robot.stand(position, station, heading));
      }
      run.end_command("");
    }
    run.measure(robot.stand(position, 0, 0), 0.1);
  }
}

/** Error of the center of mass over a sole that a robot sees, m, in the ready posture: by the
 * joint angles and the accelerometer. */
Vector2d calc_com_error(const Calibration& truth, const Calibration& estimate, bool is_left) {
  const auto seen = [&](const std::vector<double>& position, const Vector3d& up) {
    Kinematics kinematics(nao_model());
    kinematics.update(position);
    const Vector3d arm = kinematics.center_of_mass() -
                         (is_left ? kinematics.left_sole() : kinematics.right_sole()).translation();
    const Vector3d ahead = (Vector3d::UnitX() - up.x() * up).normalized();
    return Vector2d(arm.dot(ahead), arm.dot(up.cross(ahead)));
  };
  std::vector<double> position = nao_model().ready_posture().position;
  const Vector2d actual = seen(position, Vector3d::UnitZ());
  for (size_t i = 0; i < position.size(); ++i) {
    position[i] += truth.joint_zero[i] - estimate.joint_zero[i];
  }
  const Vector3d mount = estimate.imu_mount - truth.imu_mount;
  return seen(position, (Vector3d::UnitZ() + mount.cross(Vector3d::UnitZ())).normalized()) - actual;
}

Calibration random_robot(uint64_t seed) {
  Random random(seed);
  Calibration truth(nao_model());
  for (const LegDescription& leg : nao_model().legs()) {
    for (const int joint : leg.joints) {
      const int motor = nao_model().motor_of(joint);
      if (motor >= 0) truth.joint_zero[motor] = 0.5 * kDegree * random.normal();
    }
  }
  truth.imu_mount = 0.7 * kDegree * Vector3d(random.normal(), random.normal(), 0);
  truth.gyroscope_offset = 1 * kDegree * Vector3d(random.normal(), random.normal(), 0.5);
  for (double& scale : truth.foot_sensor_scale) scale = random.uniform(0.7, 1.3);
  return truth;
}

TEST(CalibrationEstimator, WithoutSamplesThereIsNoDifference) {
  const Calibration result = CalibrationEstimator(nao_model()).solve();
  EXPECT_EQ(result.joint_zero, Calibration(nao_model()).joint_zero);
}

TEST(CalibrationEstimator, APerfectRobotHasNoDifference) {
  SyntheticRobot robot(nao_model(), Calibration(nao_model()));
  CalibrationEstimator estimator(nao_model());
  stand_everywhere(robot, 2, estimator);
  const Calibration result = estimator.solve();
  for (const double zero : result.joint_zero) EXPECT_NEAR(zero, 0, 0.02 * kDegree);
  EXPECT_LT(result.imu_mount.norm(), 0.02 * kDegree);
  EXPECT_LT(estimator.pressure_error_before(), 1e-4);
}

TEST(CalibrationEstimator, TheCenterOfMassOverTheFeetIsRightToAMillimeter) {
  double before = 0;
  double after = 0;
  constexpr int kNumRobots = 20;
  for (int seed = 1; seed <= kNumRobots; ++seed) {
    const Calibration truth = random_robot(seed);
    SyntheticRobot robot(nao_model(), truth);
    robot.slope = Vector3d(0.5, -0.6, 0) * kDegree;
    CalibrationEstimator estimator(nao_model());
    stand_everywhere(robot, 4, estimator);
    const Calibration result = estimator.solve();
    for (const bool is_left : {true, false}) {
      before += calc_com_error(truth, Calibration(nao_model()), is_left).squaredNorm();
      after += calc_com_error(truth, result, is_left).squaredNorm();
    }
    EXPECT_LT((result.gyroscope_offset - truth.gyroscope_offset).norm(), 1e-9);
    EXPECT_LT(estimator.pressure_error_after(), 1.5e-3);
    EXPECT_LT(estimator.pressure_error_after(), estimator.pressure_error_before());
  }
  before = std::sqrt(before / (2 * kNumRobots));
  after = std::sqrt(after / (2 * kNumRobots));
  EXPECT_GT(before, 4e-3);
  EXPECT_LT(after, 1.5e-3);
}

TEST(CalibrationEstimator, TurnsTellTheSlopeFromTheMounting) {
  Calibration truth(nao_model());
  SyntheticRobot robot(nao_model(), truth);
  robot.slope = Vector3d(0, 1, 0) * kDegree;
  CalibrationEstimator once(nao_model());
  stand_everywhere(robot, 1, once);
  CalibrationEstimator turned(nao_model());
  stand_everywhere(robot, 4, turned);
  EXPECT_LT(turned.solve().imu_mount.norm(), 0.1 * kDegree);
  EXPECT_LE(turned.solve().imu_mount.norm(), once.solve().imu_mount.norm() + 1e-6);
}

TEST(CalibrationEstimator, FindsADeadFootSensorAndUsesTheOthers) {
  Calibration truth = random_robot(3);
  truth.foot_sensor_scale[5] = 0;
  SyntheticRobot robot(nao_model(), truth);
  CalibrationEstimator estimator(nao_model());
  stand_everywhere(robot, 4, estimator);
  const Calibration result = estimator.solve();
  ASSERT_EQ(estimator.dead_sensors(), std::vector<int>{5});
  EXPECT_EQ(result.foot_sensor_scale[5], 0);
  for (const bool is_left : {true, false}) {
    EXPECT_LT(calc_com_error(truth, result, is_left).norm(), 2.5e-3);
  }
}

TEST(CalibrationEstimator, ScalesOfFootSensorsComeNearer) {
  const Calibration truth = random_robot(4);
  SyntheticRobot robot(nao_model(), truth);
  CalibrationEstimator estimator(nao_model());
  stand_everywhere(robot, 4, estimator);
  const Calibration result = estimator.solve();
  double before = 0;
  double after = 0;
  for (size_t i = 0; i < 8; ++i) {
    before += std::abs(truth.foot_sensor_scale[i] - 1);
    after += std::abs(truth.foot_sensor_scale[i] - result.foot_sensor_scale[i]);
  }
  EXPECT_LT(after, 0.7 * before);
}

}  // namespace
}  // namespace nao
