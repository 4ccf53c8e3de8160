#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "common/random.h"
#include "daemons/vision/camera_geometry.h"
#include "daemons/vision/detection.h"
#include "daemons/vision/field_model.h"

namespace nao::trial {

/** Detections of the field's lines and circle without an image: what the camera truly sees, with
 * the misses, errors and false lines that nao-vision has in rendered images.
 *
 * Positions on the ground are computed with the estimated pose of the camera, as nao-vision does,
 * so that errors of joints and orientation act as they do there. */
class FieldErrorModel {
 public:
  /** @param field  Must outlive this. */
  FieldErrorModel(const vision::FieldModel& field, const vision::CameraCalibration& calibration,
                  int width, int height, uint64_t seed)
      : field_(field), calibration_(calibration), width_(width), height_(height), random_(seed) {}

  /** @param true_pose  Camera in the field frame. @param estimated_pose  Camera in the heading
   * frame by the robot's sensors. */
  vision::Detections detect(const Eigen::Isometry3d& true_pose,
                            const Eigen::Isometry3d& estimated_pose);

 private:
  void add_line(const cv::Point2f& from, const cv::Point2f& to,
                const vision::CameraGeometry& estimated, vision::Detections& detections);
  void add_piece(const std::vector<cv::Point2f>& piece, const vision::CameraGeometry& truth,
                 const vision::CameraGeometry& estimated, vision::Detections& detections);
  void add_circle(const Eigen::Isometry3d& true_pose, const vision::CameraGeometry& truth,
                  const Eigen::Isometry3d& estimated_pose, const vision::CameraGeometry& estimated,
                  vision::Detections& detections);

  const vision::FieldModel& field_;
  vision::CameraCalibration calibration_;
  int width_;
  int height_;
  Random random_;
};

}  // namespace nao::trial
