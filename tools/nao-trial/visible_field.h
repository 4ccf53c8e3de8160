#pragma once

#include <Eigen/Geometry>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "daemons/vision/camera_geometry.h"
#include "daemons/vision/field_model.h"

namespace nao::trial {

/** Ends of the ranges of distance, m, for which docs/vision.md gives the recall. */
constexpr double kNearRange = 3;
constexpr double kFarRange = 5;
/** Points of the center circle that are projected. */
constexpr size_t kNumCirclePoints = 72;

/** Projections of what a camera truly sees of a field. */
class VisibleField {
 public:
  /** @param field, truth  Must outlive this; the camera's pose is in the field frame. */
  VisibleField(const vision::FieldModel& field, const vision::CameraGeometry& truth, int width,
               int height)
      : field_(field), truth_(truth), width_(width), height_(height) {}

  /** Points, 0.05 m apart, of each piece of a line that is in the image; at least four. */
  std::vector<std::vector<cv::Point2f>> pieces(const vision::FieldLine& line) const;
  /** Points of the center circle that are in the image, of kNumCirclePoints. */
  std::vector<cv::Point2f> circle() const;

 private:
  bool is_in_image(const cv::Point2f& pixel) const;

  const vision::FieldModel& field_;
  const vision::CameraGeometry& truth_;
  int width_;
  int height_;
};

/** Where the center of the circle seems to be, m, in the heading frame, if the camera's pose is
 * estimated wrongly: it is moved as the middle of the visible arc is.
 * @param circle  As circle() of VisibleField, not empty. @param true_pose  Camera in the field
 * frame. @param estimated_pose  Camera in the heading frame. @return Nothing if one of them does
 * not see the ground there. */
std::optional<Eigen::Vector2d> find_seen_center(const std::vector<cv::Point2f>& circle,
                                                const vision::CameraCalibration& calibration,
                                                const Eigen::Isometry3d& true_pose,
                                                const Eigen::Isometry3d& estimated_pose);

}  // namespace nao::trial
