#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "daemons/vision/field_detector.h"

namespace nao::vision {

/** Distance between scan lines, pixels. */
constexpr int kScanSpacing = 8;

/** Where a scan line of the image crosses something white with field on both sides. */
struct LinePoint {
  /** Center in the image, pixels, weighted by brightness. */
  cv::Point2f pixel;
  /** First and last pixel of the crossing. */
  cv::Point2f first;
  cv::Point2f last;
};

/** Scans rows and columns of the image for crossings of field lines.
 *
 * A crossing begins where a pixel is brighter and less green than the field before it on the scan
 * line, and ends where the field begins again. Comparing with the field just before makes it
 * independent of shadows and of the exposure. */
std::vector<LinePoint> find_line_points(
    const FieldView& view,
    const VisionParameters::LinePoints& parameters = VisionParameters::load().line_points);

}  // namespace nao::vision
