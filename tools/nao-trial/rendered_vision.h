#pragma once

#include <Eigen/Geometry>
#include <deque>
#include <optional>
#include <string>

#include "daemons/head-camera/head_camera.h"
#include "daemons/vision/field_model.h"
#include "daemons/vision/pose_history.h"
#include "daemons/vision/vision_core.h"
#include "tools/nao-trial/trial_perception.h"

namespace nao::trial {

/** nao-head-camera's renderer and nao-vision's perception in one trial: only the renderer receives
 * the simulator's truth. Images have noise, but neither blur nor distortion, and the light is that
 * of one place. */
class RenderedVision {
 public:
  /** @param trial  Must outlive this. @throws Error  without a graphics driver. */
  RenderedVision(ClosedLoop& trial, const SceneFile& scene, const Pose2& start);

  /** To be called after every tick: keeps the robot's states. */
  void keep_state();
  /** Detections in an image that the camera takes now. */
  vision::VisionResult look(const CameraModel& camera);
  /** Camera in the heading frame at the last image, by the robot's estimated state. */
  const std::optional<Eigen::Isometry3d>& pose_camera_in_heading() const {
    return pose_camera_in_heading_;
  }
  /** Torso in the odometry frame at the last image. */
  const Pose2& heading_in_odometry() const { return heading_in_odometry_; }

 private:
  WorldState world_state() const;

  ClosedLoop& trial_;
  std::string scene_;
  vision::PoseHistory poses_;
  vision::VisionCore core_;
  camera::HeadCamera renderer_;
  Pose2 heading_in_odometry_;
  std::optional<Eigen::Isometry3d> pose_camera_in_heading_;
};

/** RenderedVision as a behavior sees it. */
class RenderedPerception : public TrialPerception {
 public:
  RenderedPerception(ClosedLoop& trial, const SceneFile& scene, const Pose2& start)
      : trial_(trial), vision_(trial, scene, start) {}

  const play::Vision& step(const std::string& camera) override;

 private:
  struct Pending {
    double due = 0;
    play::Vision vision;
  };

  ClosedLoop& trial_;
  RenderedVision vision_;
  play::Vision known_;
  std::deque<Pending> pending_;
  double next_image_ = 0;
};

}  // namespace nao::trial
