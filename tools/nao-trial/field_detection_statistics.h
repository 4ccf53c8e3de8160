#pragma once

#include <Eigen/Geometry>
#include <string>
#include <utility>
#include <vector>

#include "daemons/vision/camera_geometry.h"
#include "daemons/vision/detection.h"
#include "daemons/vision/field_model.h"

namespace nao::trial {

/** How well the field was found in images, in the terms of FieldErrorModel, which is fitted with
 * it; it is computed in the same way for rendered images and for that model. Also the distance of
 * the ball with the estimated pose of the camera. */
class FieldDetectionStatistics {
 public:
  /** @param field  Must outlive this. */
  FieldDetectionStatistics(const vision::FieldModel& field,
                           const vision::CameraCalibration& calibration, int width, int height)
      : field_(field), calibration_(calibration), width_(width), height_(height) {}

  /** Takes what one image showed.
   * @param true_pose  Camera in the field frame.
   * @param estimated_pose  Camera in the heading frame by the robot's sensors.
   * @param ball  Center of the ball in the field frame, m. */
  void add(const vision::Detections& detections, const Eigen::Isometry3d& true_pose,
           const Eigen::Isometry3d& estimated_pose, const Eigen::Vector3d& ball);

  /** Names and values, as in RunResult. Fractions are of the pieces of lines that are in the image,
   * counted once each. */
  std::vector<std::pair<std::string, double>> metrics() const;
  static std::vector<std::pair<std::string, std::string>> units();

 private:
  /** A straight piece of a field line in the image. */
  struct Piece {
    cv::Point2f from;
    cv::Point2f to;
    /** Distance of the piece's middle, m. */
    double range = 0;
    /** Fractions of the piece that detections cover: the first begin, the last end. */
    double first = 1;
    double last = 0;
    /** Fraction of the length that they cover. */
    double covered = 0;
  };
  /** Things of one range of distances: those found, and all. */
  struct Count {
    int found = 0;
    int all = 0;
    double fraction() const { return all > 0 ? static_cast<double>(found) / all : 0; }
  };

  std::vector<Piece> pieces_in(const vision::CameraGeometry& truth) const;
  void add_line(const vision::Detection& line, const vision::CameraGeometry& truth,
                std::vector<Piece>& pieces);
  bool is_arc(const vision::Detection& line, const vision::CameraGeometry& truth) const;
  void add_circle(const vision::Detections& detections, const vision::CameraGeometry& truth,
                  const Eigen::Isometry3d& true_pose, const Eigen::Isometry3d& estimated_pose);

  const vision::FieldModel& field_;
  vision::CameraCalibration calibration_;
  int width_;
  int height_;
  int num_images_ = 0;
  int num_false_ = 0;
  int num_arcs_ = 0;
  /** To 3 m, 3 to 5 m, farther. */
  Count lines_[3];
  Count circles_[2];
  std::vector<double> missing_;
  std::vector<double> pixel_errors_;
  std::vector<double> circle_errors_;
  std::vector<double> ball_errors_;
};

}  // namespace nao::trial
