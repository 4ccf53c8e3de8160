#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "daemons/vision/camera_geometry.h"
#include "daemons/vision/detection.h"
#include "daemons/vision/line_points.h"
#include "daemons/vision/vision_parameters.h"

namespace nao::vision {

/** A straight piece of a field line, in ideal pixels (CameraGeometry). */
struct LineSegment {
  cv::Point2f from;
  cv::Point2f to;
  int num_points = 0;
  /** Width across the line, pixels. */
  float width = 0;

  float length() const { return static_cast<float>(cv::norm(to - from)); }
};

/** Finds straight segments among the points of field lines by sequential RANSAC.
 *
 * Source: Fischler and Bolles, "Random sample consensus", CACM 1981; here with pairs of nearby
 * points, and with a fixed sequence of samples, so that equal images give equal results. */
class LineDetector {
 public:
  explicit LineDetector(
      const VisionParameters::LineDetector& parameters = VisionParameters::load().line_detector)
      : parameters_(parameters) {}

  /** @param points  Points that are used up are removed; the others are in another order then.
   * @param ideal  Their ideal pixels, of the same length; likewise. */
  std::vector<LineSegment> detect(std::vector<LinePoint>& points, std::vector<cv::Point2f>& ideal,
                                  const CameraGeometry& geometry) const;

 private:
  VisionParameters::LineDetector parameters_;
};

/** Detection of a segment, with its ends on the ground where the pose is known. */
Detection line_detection(const LineSegment& segment, const CameraGeometry& geometry);

}  // namespace nao::vision
