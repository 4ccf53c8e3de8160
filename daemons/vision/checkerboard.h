#pragma once

#include <opencv2/core.hpp>

namespace nao::vision {

/** Whether a patch of PatchSampler shows a checkerboard: three corners or more at which four
 * alternating squares meet. A ball's dark and light faces meet in threes.
 *
 * Source of the corners' measure: S. Bennett and J. Lasenby, "ChESS - Quick and robust detection of
 * chess-board features", Computer Vision and Image Understanding 118, 2014; here with a ring of 3
 * instead of 5 pixels, since patches are small. */
bool is_checkerboard(const cv::Mat& patch);

}  // namespace nao::vision
