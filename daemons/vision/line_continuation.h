#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "daemons/vision/line_detector.h"
#include "daemons/vision/line_points.h"

namespace nao::vision {

/** Continues segments beyond their ends by shorter ones, which have fewer points than a separate
 * segment needs: bends of the center circle, blurred or worn pieces of a line.
 *
 * Hysteresis as in J. Canny, "A computational approach to edge detection", PAMI 1986: weak
 * evidence counts where it continues strong evidence.
 *
 * @param segments  As LineDetector finds them.
 * @param points  Those that no segment used.
 * @param ideal  Their ideal pixels, of the same length.
 * @return Only the continuations. */
std::vector<LineSegment> continue_segments(const std::vector<LineSegment>& segments,
                                           const std::vector<LinePoint>& points,
                                           const std::vector<cv::Point2f>& ideal);

}  // namespace nao::vision
