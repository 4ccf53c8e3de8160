#pragma once

#include <Eigen/Core>
#include <vector>

namespace nao {

/** Sensor readings of a robot that stands still on both feet, without any correction: one tick, or
 * a mean over time. */
struct StandingSample {
  /** Encoder angles, rad, (num_motors), motor order. */
  std::vector<double> position;
  /** Specific force, m/s^2, and angular velocity, rad/s, torso frame. */
  Eigen::Vector3d accelerometer = Eigen::Vector3d::Zero();
  Eigen::Vector3d gyroscope = Eigen::Vector3d::Zero();
  /** N, in the order of RobotModel::foot_sensors(). */
  std::vector<double> foot_force;
  /** The feet have not moved between samples of one number, from 0. */
  int station = 0;
  /** Heading of the robot, counterclockwise, rad, from any direction common to all samples. */
  double heading = 0;
};

/** Mean of samples of one stand. */
class SampleMean {
 public:
  void reset() { num_samples_ = 0; }

  void add(const StandingSample& sample) {
    if (num_samples_ == 0) {
      sum_ = sample;
    } else {
      for (size_t i = 0; i < sum_.position.size(); ++i) sum_.position[i] += sample.position[i];
      for (size_t i = 0; i < sum_.foot_force.size(); ++i) {
        sum_.foot_force[i] += sample.foot_force[i];
      }
      sum_.accelerometer += sample.accelerometer;
      sum_.gyroscope += sample.gyroscope;
    }
    ++num_samples_;
  }

  int num_samples() const { return num_samples_; }

  /** Mean of the samples, of which there must be at least one. Station and heading are the first's.
   */
  StandingSample mean() const {
    StandingSample mean = sum_;
    for (double& angle : mean.position) angle /= num_samples_;
    for (double& force : mean.foot_force) force /= num_samples_;
    mean.accelerometer /= num_samples_;
    mean.gyroscope /= num_samples_;
    return mean;
  }

 private:
  StandingSample sum_;
  int num_samples_ = 0;
};

}  // namespace nao
