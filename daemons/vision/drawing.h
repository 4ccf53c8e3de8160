#pragma once

#include <opencv2/core.hpp>

#include "daemons/vision/vision_core.h"

namespace nao::vision {

/** Draws boxes, lines, kinds and distances over an image. */
void draw_result(const VisionResult& result, cv::Mat& bgr);

}  // namespace nao::vision
