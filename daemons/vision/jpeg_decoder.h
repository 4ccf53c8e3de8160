#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <string>

namespace nao::vision {

/** Decodes a JPEG file that may be truncated or malicious.
 * @return Why the file is refused; empty if `bgr` holds the image. Refused are files that are not
 * JPEG, are larger than 1280x960 pixels, end early, or contain errors that libjpeg would gloss
 * over. @throws Error  if libturbojpeg cannot be initialized. */
[[nodiscard]] std::string decode_jpeg(const uint8_t* data, size_t num_bytes, cv::Mat& bgr);

}  // namespace nao::vision
