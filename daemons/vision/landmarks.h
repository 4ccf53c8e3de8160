#pragma once

#include <optional>
#include <vector>

#include "daemons/vision/camera_geometry.h"
#include "daemons/vision/detection.h"
#include "daemons/vision/field_detector.h"
#include "daemons/vision/line_detector.h"
#include "daemons/vision/vision_parameters.h"

namespace nao::vision {

/** Finds where lines meet: L where two end, T where one does, X where none does. */
class CrossingDetector {
 public:
  explicit CrossingDetector(const VisionParameters::CrossingDetector& parameters)
      : parameters_(parameters) {}

  Detections detect(const std::vector<LineSegment>& segments, const FieldView& view,
                    const CameraGeometry& geometry) const;

 private:
  VisionParameters::CrossingDetector parameters_;
};

/** Finds the center circle among the points of lines; needs the camera's pose.
 *
 * RANSAC on the ground with the known radius: two points give two centers. */
class CenterCircleDetector {
 public:
  /** @param radius  m. */
  explicit CenterCircleDetector(const VisionParameters::CenterCircle& parameters,
                                double radius = 0.75)
      : parameters_(parameters), radius_(radius) {}

  /** @param points, ideal  Points that lie on the circle are removed. */
  std::optional<Detection> detect(std::vector<LinePoint>& points, std::vector<cv::Point2f>& ideal,
                                  const CameraGeometry& geometry) const;

 private:
  VisionParameters::CenterCircle parameters_;
  double radius_;
};

}  // namespace nao::vision
