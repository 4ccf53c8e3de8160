#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <functional>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <utility>

#include "daemons/vision/ball_detector.h"
#include "daemons/vision/ball_filter.h"
#include "daemons/vision/camera_geometry.h"
#include "daemons/vision/detection.h"
#include "daemons/vision/image_status.h"
#include "daemons/vision/landmarks.h"
#include "daemons/vision/localizer.h"
#include "daemons/vision/object_detector.h"
#include "daemons/vision/vision_parameters.h"
#include "kinematics/pose2.h"

namespace nao::vision {

/** One image, and what is known about the camera when it was taken. */
struct VisionInput {
  /** 8 bits a color, blue first, at least 64x48 pixels. */
  cv::Mat bgr;
  /** Robot time at mid exposure, microseconds. */
  int64_t utime = 0;
  /** Camera name from the robot's description. */
  std::string camera;
  CameraCalibration calibration;
  /** Camera axes (x along the view, y left, z up) in the heading frame H. Nothing: detections have
   * no positions, and only ball, lines and crossings are found. */
  std::optional<Eigen::Isometry3d> pose_camera_in_heading;
  /** H in the odometry frame. Nothing: neither ball nor pose on the field are tracked. */
  std::optional<Pose2> heading_in_odometry;
  /** The robot stands or walks; what it sees while it falls does not serve localisation. */
  bool is_upright = true;
};

/** Settings of the whole process for perception: one thread, since more cost more than they save on
 * small images; and the memory of an image is kept for the next one, since returning and taking it
 * again takes a sixth of the time. */
void configure_process();

/** Results of one image. */
struct VisionResult {
  ImageStatus image_status = ImageStatus::kOk;
  Detections detections;
  BallEstimate ball;
  FieldPose field_pose;
};

/** Networks of the detectors; cores may share them, in one thread. */
struct VisionNetworks {
  std::shared_ptr<NeuralNetwork> objects;
  BallNetworks ball;

  /** Loads the networks in data_path(). @throws Error  if one cannot be read. */
  static VisionNetworks load();
};

/** Perception of one robot: finds field, lines, crossings, the center circle, posts, robots and the
 * ball in images, and tracks the ball and the pose on the field. It uses neither a clock nor the
 * bus. */
class VisionCore {
 public:
  /** @throws Error  if a network cannot be read. */
  explicit VisionCore(const VisionNetworks& networks = VisionNetworks::load(),
                      const VisionParameters& parameters = VisionParameters::load());

  /** @throws MessageError  if the image has another format or is too small. */
  VisionResult process(const VisionInput& input);

  /** From now on the pose on the field is estimated; see Localizer. */
  void localize(const FieldModel& field, const Pose2& start) {
    localizer_.emplace(field, start, parameters_);
  }

  /** Called with the stage's name after each stage; for measuring them. */
  void on_stage(std::function<void(const char*)> callback) { on_stage_ = std::move(callback); }

 private:
  void finish_stage(const char* name) const {
    if (on_stage_) on_stage_(name);
  }
  void localize(const VisionInput& input, VisionResult& result);
  /** @param obstacles  They hide the lines; what is in their boxes is not a line. */
  void find_lines(const FieldView& view, const CameraGeometry& geometry,
                  const Detections& obstacles, VisionResult& result);

  VisionParameters parameters_;
  ImageStatusMonitor status_;
  FieldDetector field_;
  LineDetector lines_;
  CrossingDetector crossings_;
  CenterCircleDetector circle_;
  ObjectDetector objects_;
  BallDetector ball_;
  BallFilter ball_filter_;
  std::optional<Localizer> localizer_;
  std::function<void(const char*)> on_stage_;
};

}  // namespace nao::vision
