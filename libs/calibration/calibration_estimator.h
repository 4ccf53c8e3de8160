#pragma once

#include <Eigen/Core>
#include <vector>

#include "calibration/calibration.h"
#include "calibration/standing_sample.h"
#include "kinematics/kinematics.h"
#include "robot_model/robot_model.h"

namespace nao {

/** Standard deviations of what is estimated, before and between measurements. The defaults are
 * those of data/disturbances/real.yaml where it has them. */
struct CalibrationPrior {
  /** Deviation of a leg joint's zero, rad: 0.5 degrees, and as much from the play of its gear,
   * which stays on one flank under load. */
  double joint_zero = 0.012;
  /** Deviation of the inertial unit's mounting and the accelerometer's offset, rad (0.8 degrees).
   */
  double imu_mount = 0.014;
  /** Deviation of a foot sensor's factor. */
  double foot_sensor = 0.2;
  /** Deviation of the center of mass in the torso frame, m: 5 mm for the torso, a quarter of the
   * mass.
   */
  double center_of_mass = 0.001;
  /** Deviation of the floor's slope, and of the floor under one foot against it, rad (0.5 degrees
   * each). */
  double slope = 0.009;
  double foot_tilt = 0.009;

  // Errors of one sample.
  /** Tilt of a sole by play of the gears and soft ground, rad (0.5 degrees). */
  double sole_noise = 0.009;
  /** Distance of the center of pressure from the center of mass's projection, m: half a degree of
   * play in ankle and hip. */
  double pressure_noise = 0.004;
  /** Deviation of the sum of the forces, as a fraction of the weight: sensor noise. A weight that
   * differs from the model's is the same in all samples, and the sensors' factors absorb it. */
  double weight_noise = 0.01;
};

/** Estimates a calibration from stands in several postures: maximum a posteriori.
 *
 * Unknown: zeros z of the leg joints, rotation m of the inertial unit (about x and y), factors 1 +
 * k of the foot sensors, displacement c of the center of mass in the torso, slope s of the floor,
 * and the tilt t of the floor under each foot of each station. With the true angles q - z and the
 * true upward direction u = a + m x a, where a is the direction that the accelerometer measures,
 * every sample says
 *
 *     (R_TF^T u)_xy = Rz(-heading) s + t          each sole lies on the floor        4 equations
 *     (p_cop - p_com - c) perpendicular to u = 0  the weight acts below the CoM      2 equations
 *     sum (1 + k_i) f_i = m g                     the feet carry the robot           1 equation
 *
 * with the CoP p_cop = sum (1 + k_i) f_i p_i / sum (1 + k_i) f_i. A sensor that reads nothing while
 * the others of its foot are loaded is dead: its force is the weight less the other sensors'
 * forces. With two or more dead sensors the last three equations are left out.
 *
 * The prior divides what the samples cannot distinguish (slope and mounting without a turn, joints
 * that turn the sole in the same way): sets of errors that no stand distinguishes have the same
 * effect on all stands. Gauss-Newton with the prior's information added. The gyroscope is assumed
 * to be at rest in all samples: its offset is their mean. */
class CalibrationEstimator {
 public:
  explicit CalibrationEstimator(const RobotModel& model, const CalibrationPrior& prior = {});

  /** Adds a stand. */
  void add(const StandingSample& sample) { samples_.push_back(sample); }
  int num_samples() const { return static_cast<int>(samples_.size()); }

  /** Calibration of greatest probability. The gyroscope's offset is the mean of all samples; its
   * scale is 1. Without a sample: no difference. */
  Calibration solve();

  /** Foot sensors that were dead in the last solve(). */
  const std::vector<int>& dead_sensors() const { return dead_sensors_; }
  /** Root mean square of the distance from the CoP to the point below the CoM, m, in the samples:
   * without and with the last solve()'s calibration. */
  double pressure_error_before() const { return pressure_error_before_; }
  double pressure_error_after() const { return pressure_error_after_; }

 private:
  /** Residuals of a stand: tilt of both soles (4), CoP against CoM (2), weight (1). */
  static constexpr int kNumRows = 7;
  using Rows = Eigen::Matrix<double, kNumRows, 1>;

  void find_dead_sensors();
  /** Residuals, each divided by its standard deviation. */
  Rows calc_residuals(const StandingSample& sample, const Eigen::VectorXd& parameters);
  double calc_pressure_error(const Eigen::VectorXd& parameters);
  Eigen::VectorXd calc_deviations() const;
  Calibration to_calibration(const Eigen::VectorXd& parameters) const;

  // Indices of the first parameter of each kind.
  int mount_index() const { return static_cast<int>(motors_.size()); }
  int sensor_index() const { return mount_index() + 2; }
  int com_index() const { return sensor_index() + static_cast<int>(is_left_sensor_.size()); }
  int slope_index() const { return com_index() + 2; }
  int station_index(int station) const { return slope_index() + 2 + 4 * station; }
  int num_parameters() const;

  const RobotModel* model_;
  CalibrationPrior prior_;
  Kinematics kinematics_;
  /** Motors of the legs. */
  std::vector<int> motors_;
  std::vector<bool> is_left_sensor_;
  std::vector<StandingSample> samples_;
  std::vector<int> dead_sensors_;
  double pressure_error_before_ = 0;
  double pressure_error_after_ = 0;
  /** Reused. */
  std::vector<double> position_;
};

}  // namespace nao
