#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "daemons/vision/field_model.h"
#include "daemons/vision/field_observation.h"
#include "daemons/vision/pose_filter.h"
#include "daemons/vision/pose_search.h"
#include "daemons/vision/vision_parameters.h"
#include "kinematics/pose2.h"

namespace nao::vision {

/** Where the robot is on the field. */
struct FieldPose {
  bool is_known = false;
  /** Heading frame (on the ground below the torso) in the field frame. */
  Pose2 pose;
  /** Covariance of x, y, m, and heading, rad. */
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
};

/** Estimates the robot's pose on the field: from a known start, by odometry, and by the lines,
 * center circle and goal posts that images show.
 *
 * PoseFilter tracks the pose. PoseSearch looks for another one when what was seen in the last
 * seconds does not fit the tracked one: the robot was carried. Meanwhile the pose is unknown. Only
 * the heading, which the gyroscope keeps, then tells one half of the field from the other, and the
 * camera is taken to be tilted as it usually is. */
class Localizer {
 public:
  /** The odometry frame begins where the robot stands when nao-motion starts.
   * @param start  Pose of the odometry frame on the field, m, rad. */
  Localizer(const FieldModel& field, const Pose2& start,
            const VisionParameters& parameters = VisionParameters::load());
  Localizer(const Localizer&) = delete;
  Localizer& operator=(const Localizer&) = delete;

  /** Advances the estimate to a time. A step back in time restarts it: the simulation was
   * restarted. An odometry jump that no robot can walk is not a motion: nao-motion was restarted.
   * @param utime  Robot time, microseconds.
   * @param is_upright  The robot stands or walks. Falling and getting up make the pose uncertain.
   */
  void predict(int64_t utime, const Pose2& heading_in_odometry, bool is_upright = true);

  /** Takes what the image of the last predict()'s time showed; ignored while not upright. */
  void observe(const FieldObservation& observation);

  FieldPose estimate() const;
  /** Estimated error of the camera's tilt about the x and y axes of the heading frame in the last
   * image, rad; zero while the pose is unknown. */
  Eigen::Vector2d tilt() const;

 private:
  void restart(const Pose2& heading_in_odometry);
  void remember(const FieldObservation& observation);
  void check();
  void give_up();
  /** The newest observations, at most `count`, as seen from the present pose with the camera's
   * tilt as it is known now. */
  std::vector<FieldObservation> newest(size_t count) const;

  VisionParameters::Localizer parameters_;
  FieldModel field_;
  Pose2 start_;
  PoseFilter filter_;
  PoseSearch search_;
  bool is_started_ = false;
  bool is_lost_ = false;
  bool is_upright_ = true;
  int64_t utime_ = 0;
  Pose2 odometry_;
  std::vector<FieldObservation> window_;
  /** Mean of the slow errors of the tilt while the pose fitted well, rad, and of how many
   * observations, at the beginning. */
  Eigen::Vector2d usual_tilt_ = Eigen::Vector2d::Zero();
  int num_fits_ = 0;
  int64_t remembered_utime_ = 0;
  int64_t searched_utime_ = 0;
  int num_misfits_ = 0;
};

}  // namespace nao::vision
