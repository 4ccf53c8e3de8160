#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <string>

namespace nao::vision {

/** Decodes JPEG files that may be truncated or malicious. */
class JpegDecoder {
 public:
  /** @throws Error  if libturbojpeg cannot be initialized. */
  JpegDecoder();
  ~JpegDecoder();
  JpegDecoder(const JpegDecoder&) = delete;
  JpegDecoder& operator=(const JpegDecoder&) = delete;

  /** @return Why the file is refused; empty if `bgr` holds the image. Refused are files that are
   * not JPEG, are larger than 1280x960 pixels, end early, or contain errors that libjpeg would
   * gloss over. */
  [[nodiscard]] std::string decode(const uint8_t* data, size_t num_bytes, cv::Mat& bgr);

 private:
  std::string decode_once(const uint8_t* data, size_t num_bytes, cv::Mat& bgr);

  void* handle_;
};

}  // namespace nao::vision
