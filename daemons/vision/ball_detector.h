#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "daemons/vision/camera_geometry.h"
#include "daemons/vision/detection.h"
#include "daemons/vision/field_detector.h"

namespace nao::vision {

/** Something round that may be a ball, and what tells a ball from other things. */
struct BallCandidate {
  /** Circle in the image, pixels. */
  cv::Point2f center;
  float radius = 0;
  /** Mean step from outside to inside along the circle, 0 to 1. */
  float edge = 0;
  /** Fraction of the disk that is much darker than its bright part. */
  float dark = 0;
  /** Brightness of its bright part above the field, levels of 255. */
  float contrast = 0;
  /** Saturation that 80 % of the bright pixels of the disk stay below, 0 to 1. */
  float saturation = 0;
  /** Fraction of the disk that has the field's color. */
  float green = 0;
};

/** Finds the ball: black and white, on the field.
 *
 * Candidates are places where the inside of a circle is not of the field's color and its
 * surroundings are; with the camera's pose only circles of the size that a ball has there. Each is
 * fitted to the edge of the field's color, and judged by that edge and by its pattern. */
class BallDetector {
 public:
  /** @param radius  m. */
  explicit BallDetector(double radius = 0.05) : radius_(radius) {}

  std::optional<Detection> detect(const FieldView& view, const CameraGeometry& geometry) const;

  /** The candidates, best first; for tuning. */
  std::vector<BallCandidate> candidates(const FieldView& view,
                                        const CameraGeometry& geometry) const;

  /** 0: no ball, 1: certainly one; at least kAccept for a detection. */
  static double confidence(const BallCandidate& candidate);
  static constexpr double kAccept = 0.5;

 private:
  double radius_;
};

}  // namespace nao::vision
