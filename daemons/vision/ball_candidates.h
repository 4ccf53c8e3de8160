#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "daemons/vision/camera_geometry.h"
#include "daemons/vision/field_detector.h"

namespace nao::vision {

/** A place where a ball may be, pixels of the image. */
struct BallHint {
  cv::Point2f center;
  float radius = 0;
  /** Mean of FieldView::other inside less that outside. */
  float score = 0;
};

/** Searches FieldView::other for disks that are surrounded by field, by an integral image.
 * @param ball_radius  m. @return The best ones, not overlapping. */
std::vector<BallHint> find_ball_hints(const FieldView& view, const CameraGeometry& geometry,
                                      double ball_radius);

}  // namespace nao::vision
