#pragma once

#include <deque>
#include <optional>

#include "common/random.h"
#include "daemons/vision/ball_filter.h"
#include "kinematics/kinematics.h"
#include "tools/nao-trial/trial_perception.h"

namespace nao::trial {

/** Errors of perception, which stand for rendered images and nao-vision. Sources: docs/vision.md,
 * unless a value says otherwise. */
struct PerceptionErrors {
  /** Images a second: what nao-play requests. */
  double rate = 15;
  /** Probability that a ball in the image is found, to 3 m and to 5 m; beyond: never. */
  double recall_near = 0.98;
  double recall_far = 0.895;
  /** Probability of a false ball in an image without one. */
  double false_balls = 0.002;
  /** Standard deviations of the ball's direction, rad: to the side, and of its depression, which
   * becomes an error of distance. Chosen above the measured 0.1 degrees with the exact pose of the
   * camera: while walking the pose comes from the estimated state. */
  double bearing = 0.008;
  double depression = 0.012;
  /** Errors of the pose on the field: m in each direction, and rad; both change slowly. Chosen from
   * the median errors that localisation must reach (6 cm and 3 degrees). */
  double position = 0.05;
  double heading = 0.035;
  /** Probability that a robot nearer than 3 m is found, and standard deviation of its distance as a
   * fraction: with the exact pose of the camera the median error is 4 %. */
  double robot_recall = 0.88;
  double robot_distance = 0.1;
  /** Time constant of these errors, s. Chosen. */
  double time_constant = 10;
};

/** Perception made from the truth, with errors. The ball passes through nao-vision's own filter. */
class PerceptionModel : public TrialPerception {
 public:
  /** @param trial  Must outlive this. @param team  0: it plays along the world's x axis. */
  PerceptionModel(ClosedLoop& trial, const PerceptionErrors& errors, uint64_t seed, int team = 0);

  const play::Vision& step(const std::string& camera) override;

 private:
  struct Pending {
    double due = 0;
    play::Vision vision;
  };

  void take_image(const CameraModel& camera);
  /** Where the ball is seen, m, in the odometry frame; nothing: it is not. */
  std::optional<Eigen::Vector2d> measure(const CameraModel& camera);
  void update_ball(const Eigen::Vector2d& seen);
  /** Other robots, m, in the odometry frame. */
  std::vector<Eigen::Vector2d> see_robots(const CameraModel& camera);
  void drift(double dt);

  ClosedLoop& trial_;
  PerceptionErrors errors_;
  Pose2 field_in_world_;
  Random random_;
  Kinematics kinematics_;
  vision::BallFilter filter_;
  play::Vision known_;
  std::deque<Pending> pending_;
  /** Time since the last image, s. */
  double since_image_ = 0;
  Eigen::Vector3d field_error_ = Eigen::Vector3d::Zero();
};

}  // namespace nao::trial
